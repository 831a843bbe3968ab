#include "compensation/table_chord.h"

#include <algorithm>
#include <cmath>

#include "compensation/above.h"
#include "compensation/correct_by_table.h"
#include "compensation/lu6.h"
#include "compensation/table_motion.h"

namespace truepose::compensation {
namespace {

constexpr int kMostSteps = 8;
constexpr double kLeastContraction = 0.5;
// Of a correction, by weights and sums in float.
constexpr double kRoundedShare = 4e-7;
// A last step is taken without a look when ten times what the contraction promises is nothing.
constexpr double kPromiseMargin = 10;

// Joint steps by remainders, with lengths over the characteristic length.
class Newton {
 public:
  Newton(const JointChain& chain, double length_m) : chain_(chain), length_m_(length_m) {}

  // @returns false when a singular value is not above `least`, or there is no inverse.
  bool Set(const Sweep& sweep, double least) {
    Eigen::Matrix<double, 6, 6> J;
    for (int i = 0; i < 6; ++i) {
      J.col(i) = ColumnOf(chain_, sweep, i);
      if (chain_.prismatic[i]) J.col(i) *= length_m_;
    }
    J.topRows<3>() /= length_m_;
    return SingularValuesAreAbove(J, least) && lu_.Factor(J);
  }

  // @returns the largest part of the step, rad or lengths.
  double Step(const Twist& remainder, double* step) const {
    Twist weighted = remainder;
    weighted.head<3>() /= length_m_;
    lu_.Solve(weighted, step);
    double largest = 0;
    for (int i = 0; i < 6; ++i) {
      largest = std::max(largest, std::abs(step[i]));
      if (chain_.prismatic[i]) step[i] *= length_m_;
    }
    return largest;
  }

 private:
  const JointChain& chain_;
  double length_m_;
  Lu6 lu_;
};

// What E does to the flange, to first order: the step is no better.
Twist FirstRemainder(const JointChain& chain, const Motions& motions, const Sweep& sweep,
                     const Delta& delta) {
  Eigen::Matrix3d R_BL = sweep.X_BF.R * chain.constant[6].R.transpose();
  if (!chain.prismatic[5]) {
    const double c = motions[5].cosine, s = motions[5].sine;
    const Eigen::Vector3d x = R_BL.col(0) * c - R_BL.col(1) * s;
    R_BL.col(1) = R_BL.col(1) * c + R_BL.col(0) * s;
    R_BL.col(0) = x;
  }
  const Eigen::Vector3d turn = R_BL * delta.tail<3>();
  Twist e;
  e << -(R_BL * delta.head<3>() + turn.cross(sweep.X_BF.p - sweep.axis[5].p)), -turn;
  return e;
}

// Moves the joints by Newton's step. @returns false when it is too long for that.
bool Advance(const JointChain& chain, const Newton& newton, Motions* motions, TableChord* state) {
  double step[6];
  if (!(newton.Step(state->remainder, step) <= kLongestSmallStep)) return false;
  for (int i = 0; i < 6; ++i) state->q_chain[i] += step[i];
  AddSmallStep(chain, step, motions);
  return true;
}

double SizeOf(const Twist& remainder) { return remainder.cwiseAbs().maxCoeff(); }

ChordEnd Iterate(const Table& table, const Newton& newton, const Pose& desired, Motions* motions,
                 TableChord* state) {
  const JointChain& chain = table.arm.nominal;
  const TableTolerance tolerance(table, state->delta);
  double before = SizeOf(state->remainder);
  for (state->iterations = 1; state->iterations <= kMostSteps; ++state->iterations) {
    if (!Advance(chain, newton, motions, state)) return ChordEnd::kGivenUp;
    const Lookup lookup = LookUp(table, state->q_chain.data(), Reach::kGrid);
    state->axis = lookup.axis;
    if (lookup.fault != LookupFault::kNone) return ChordEnd::kOutside;
    state->remainder = Remainder(desired, CorrectedFlange(chain, *motions, lookup.delta));
    if (tolerance.IsMet(state->remainder)) return ChordEnd::kReached;
    const double contraction = SizeOf(state->remainder) / before;
    if (!(contraction < kLeastContraction)) return ChordEnd::kGivenUp;
    before = SizeOf(state->remainder);
    const Twist promised = kPromiseMargin * contraction * state->remainder;
    if (!tolerance.IsMet(promised)) continue;
    if (!Advance(chain, newton, motions, state)) return ChordEnd::kGivenUp;
    state->remainder = promised;
    return ChordEnd::kReached;
  }
  return ChordEnd::kGivenUp;
}

}  // namespace

TableTolerance::TableTolerance(const Table& table, const Delta& delta) noexcept {
  const double turn = delta.tail<3>().norm();
  const double shift = delta.head<3>().norm() + turn * table.header.characteristic_length_m;
  position_m = kTablePositionTolerance + kRoundedShare * shift;
  rotation_rad = kTableRotationTolerance + kRoundedShare * turn;
}

bool TableTolerance::IsMet(const Twist& remainder) const noexcept {
  return remainder.head<3>().squaredNorm() <= position_m * position_m &&
         remainder.tail<3>().squaredNorm() <= rotation_rad * rotation_rad;
}

ChordEnd CorrectByChords(const Table& table, TableChord* state) noexcept {
  const JointChain& chain = table.arm.nominal;
  Motions motions;
  SetMotions(chain, state->q_chain.data(), &motions);
  Sweep sweep;
  RunSweep(chain, motions, &sweep);
  Newton newton(chain, table.header.characteristic_length_m);
  if (!newton.Set(sweep, table.header.smallest_singular_value)) return ChordEnd::kGivenUp;
  state->remainder = FirstRemainder(chain, motions, sweep, state->delta);
  return Iterate(table, newton, sweep.X_BF, &motions, state);
}

}  // namespace truepose::compensation
