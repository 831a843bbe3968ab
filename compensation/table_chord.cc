#include "compensation/table_chord.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

  // @returns the sum of the step's parts, rad or lengths; infinite where one is too long for
  // AddSmallStep, or no number.
  double Step(const Twist& remainder, double* step) {
    weighted_ = remainder;
    weighted_.head<3>() /= length_m_;
    inverse_.Solve(weighted_, step_);
    double length = 0;
    for (int i = 0; i < 6; ++i) {
      const double part = std::abs(step_[i]);
      length += part <= kLongestSmallStep ? part : std::numeric_limits<double>::infinity();
      step[i] = step_[i] * (chain_.prismatic[i] ? length_m_ : 1);
    }
    return length;
  }

  // A twist whose norms are at least those of what the last step leaves, `way` the lengths of all
  // steps with this one, the last: what rounding has not solved, and that the Jacobian and E change
  // by about as much as joints have moved since it was taken. 150 random arms with errors of 0.3 to
  // 8 mm, on tables of three nodes an axis, left 0.3 of the second part at worst. How the remainder
  // shrank before says less: by luck it did so tenfold.
  Twist BoundOfRemainder(double way, double last) const {
    const double left = way * last + inverse_.Unsolved(weighted_, step_).norm();
    return {length_m_ * left, 0, 0, left, 0, 0};
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
  Twist weighted_;  // the last remainder and its step, as numbers alone
  double step_[6];
};

// What E does to the flange, to first order: the step is no better.
Twist FirstRemainder(const TableSweep& sweep, const Delta& delta) {
  const Eigen::Vector3d turn = sweep.X_BL.R * delta.tail<3>();
  Twist e;
  e << -(sweep.X_BL.R * delta.head<3>() + turn.cross(sweep.X_BF.p - sweep.X_BL.p)), -turn;
  return e;
}

// Moves the joints by Newton's step. @returns its length.
double Advance(const JointChain& chain, Newton* newton, Motions* motions, TableChord* state) {
  double step[6];
  const double length = newton->Step(state->remainder, step);
  for (int i = 0; i < 6; ++i) state->q_chain[i] += step[i];
  AddSmallStep(chain, step, motions);
  return length;
}

// The remainder where the joints have come. @returns false outside of the grid.
bool Look(const Table& table, const Pose& desired, const Motions& motions, TableChord* state) {
  const Lookup lookup = LookUp(table, state->q_chain.data(), Reach::kGrid);
  ++state->iterations;
  state->axis = lookup.axis;
  if (lookup.fault != LookupFault::kNone) return false;
  state->remainder = Remainder(desired, CorrectedFlange(table, motions, lookup.delta));
  return true;
}

ChordEnd Iterate(const Table& table, Newton* newton, const Pose& desired, Motions* motions,
                 TableChord* state) {
  const TableTolerance tolerance(table, state->delta);
  double way = 0, before = std::numeric_limits<double>::infinity();
  while (state->iterations < kMostSteps) {
    const double step = Advance(table.arm.nominal, newton, motions, state);
    if (!(step < kLeastContraction * before)) return ChordEnd::kGivenUp;
    way += step;
    before = step;
    // Only the grid says where joints may go: the first place is looked at in any case.
    if (state->iterations > 0) {
      const Twist bound = newton->BoundOfRemainder(way, step);
      if (tolerance.IsMet(bound)) {
        state->remainder = bound;
        return ChordEnd::kReached;
      }
    }
    if (!Look(table, desired, *motions, state)) return ChordEnd::kOutside;
    if (tolerance.IsMet(state->remainder)) return ChordEnd::kReached;
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
  return Iterate(table, &newton, sweep.X_BF, &motions, state);
}

}  // namespace truepose::compensation
