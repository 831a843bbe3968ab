#include "compensation/table_chord.h"

#include <algorithm>
#include <cmath>

#include "compensation/above.h"
#include "compensation/correct_by_table.h"
#include "compensation/inverse6.h"
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
  bool Set(const TableSweep& sweep, double least) {
    Eigen::Matrix<double, 6, 6> J;
    for (int i = 0; i < 6; ++i) SetColumn(sweep, i, &J(0, i));
    if (!inverse_.Set(J)) return false;
    const bool surely = least * least * inverse_.SquaredNorm() <= 1;
    return surely || SingularValuesAreAbove(J, least);
  }

  // @returns the largest part of the step, rad or lengths.
  double Step(const Twist& remainder, double* step) const {
    Twist weighted = remainder;
    weighted.head<3>() /= length_m_;
    inverse_.Solve(weighted, step);
    double largest = 0;
    for (int i = 0; i < 6; ++i) {
      largest = std::max(largest, std::abs(step[i]));
      if (chain_.prismatic[i]) step[i] *= length_m_;
    }
    return largest;
  }

 private:
  void SetColumn(const TableSweep& sweep, int joint, double* column) const {
    const JointAxis& axis = sweep.axis[joint];
    const bool slides = chain_.prismatic[joint];
    const Eigen::Vector3d arm = (sweep.X_BF.p - axis.p) / length_m_;
    const Eigen::Vector3d shift = slides ? axis.u : axis.u.cross(arm);
    for (int i = 0; i < 3; ++i) column[i] = shift(i);
    for (int i = 0; i < 3; ++i) column[3 + i] = slides ? 0 : axis.u(i);
  }

  const JointChain& chain_;
  double length_m_;
  Inverse6 inverse_;
};

// What E does to the flange, to first order: the step is no better.
Twist FirstRemainder(const TableSweep& sweep, const Delta& delta) {
  const Eigen::Vector3d turn = sweep.X_BL.R * delta.tail<3>();
  Twist e;
  e << -(sweep.X_BL.R * delta.head<3>() + turn.cross(sweep.X_BF.p - sweep.X_BL.p)), -turn;
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
    state->remainder = Remainder(desired, CorrectedFlange(table, *motions, lookup.delta));
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
  const PoseError& asked = table.header.tolerance;
  position_m = std::max(kLeastSolved, kSolvedShare * asked.position_m) + kRoundedShare * shift;
  rotation_rad = std::max(kLeastSolved, kSolvedShare * asked.rotation_rad) + kRoundedShare * turn;
}

bool TableTolerance::IsMet(const Twist& remainder) const noexcept {
  return remainder.head<3>().squaredNorm() <= position_m * position_m &&
         remainder.tail<3>().squaredNorm() <= rotation_rad * rotation_rad;
}

ChordEnd CorrectByChords(const Table& table, TableChord* state) noexcept {
  const JointChain& chain = table.arm.nominal;
  Motions motions;
  SetMotions(chain, state->q_chain.data(), &motions);
  TableSweep sweep;
  SweepTable(table, motions, &sweep);
  Newton newton(chain, table.header.characteristic_length_m);
  if (!newton.Set(sweep, table.header.smallest_singular_value)) return ChordEnd::kGivenUp;
  state->remainder = FirstRemainder(sweep, state->delta);
  return Iterate(table, newton, sweep.X_BF, &motions, state);
}

}  // namespace truepose::compensation
