#include "compensation/correct_by_table.h"

#include <algorithm>
#include <cmath>

#include "compensation/least_squares.h"
#include "compensation/singularity.h"
#include "compensation/table_chord.h"
#include "compensation/table_motion.h"
#include "compensation/valid.h"

namespace truepose::compensation {
namespace {

// Errors of centimetres near a singularity take tens of rounds, those of a robot three.
constexpr int kMostLookups = 60;
// Of fewer than six joints, whose remainder does not say when they have come to rest: they do
// within what the tolerances of the flange are to joints.
constexpr double kSettled = 10;
// They may move by so many times the error that they undo, as in exact compensation.
const double kLargestGain = 0.1 / ExactOptions().singular_threshold;

// Any arm. A lookup gives the pose that the nominal chain has to reach, which gives the next place
// to look up: the correction changes little with the joints, so a round takes 1e-3 of the error.
class TableSlowWay {
 public:
  TableSlowWay(const Table& table, const double* q, const Delta& delta)
      : table_(table), start_(q), tolerance_(table, delta) {
    const Arm& arm = table.arm;
    const ExactOptions defaults;
    task_.arm = &arm;
    task_.chain = &arm.nominal;
    task_.length_m = table.header.characteristic_length_m;
    if (Joints() < 6) {
      task_.weight = Eigen::Map<const Twist>(defaults.weight.data());
    } else {
      task_.weight.head<3>().setConstant(1 / task_.length_m);
    }
  }

  Correction Correct() {
    Correction result;
    std::copy_n(start_, Joints(), result.q.data());
    X_target_ = NominalFlange(table_.arm, start_);
    result.smallest_singular_value = SmallestSingularValue(table_.arm, start_, task_.length_m);
    Look(&result);
    error_ = remainder_.head<3>().norm() / task_.length_m + remainder_.tail<3>().norm();
    if (result.smallest_singular_value < table_.header.smallest_singular_value) {
      result.outcome = Outcome::kNearSingular;
    } else {
      Iterate(&result);
    }
    return result;
  }

 private:
  int Joints() const { return table_.header.joints; }

  void Iterate(Correction* result) {
    for (int round = 0; round < kMostLookups; ++round) {
      const double moved = Move(result);
      if (Joints() < 6 && !settled_) break;
      if (!Look(result)) return;
      if (!(Joints() < 6 ? moved <= Rest() : tolerance_.IsMet(remainder_))) continue;
      result->outcome = Outcome::kOk;
      if (Joints() < 6 && IsLargeForItsError(*result)) Refuse(result);
      return;
    }
    result->outcome = Outcome::kUnreachable;
    if (Joints() < 6) Refuse(result);
  }

  // rad or lengths; whichever of position and rotation asks for less.
  double Rest() const {
    return kSettled * std::min(tolerance_.position_m / task_.length_m, tolerance_.rotation_rad);
  }

  // The weighted coordinates hardly tell where a joint should be: the least remainder is far away,
  // or was not found.
  void Refuse(Correction* result) {
    std::copy_n(start_, Joints(), result->q.data());
    Look(result);
    result->outcome = Outcome::kNearSingular;
  }

  // The largest change of a joint, rad or lengths.
  double Moved(const double* from, const JointArray& to) const {
    double largest = 0;
    for (int i = 0; i < Joints(); ++i) {
      const double unit = table_.arm.nominal.prismatic[i] ? task_.length_m : 1;
      largest = std::max(largest, std::abs(to[i] - from[i]) / unit);
    }
    return largest;
  }

  bool IsLargeForItsError(const Correction& result) const {
    return Moved(start_, result.q) > kLargestGain * error_;
  }

  // To joints whose nominal flange is where the correction of the last ones asks for.
  // @returns how far they are from the last ones.
  double Move(Correction* result) {
    task_.desired = X_nominal_ * Inverse(X_corrected_) * X_target_;
    LeastSquaresResult solved = SolveLeastSquares(task_, start_);
    if (solved.reached && Joints() > 6) solved = DrawTowards(task_, start_, solved);
    result->iterations += solved.iterations;
    settled_ = solved.settled;
    const double moved = Moved(result->q.data(), solved.v);
    result->q = solved.v;
    return moved;
  }

  // Poses and errors at the joints of `result`. @returns false outside of the grid.
  bool Look(Correction* result) {
    JointArray q_chain;
    ChainJoints(table_, result->q.data(), q_chain.data());
    const Lookup lookup = LookUp(table_, q_chain.data(), Reach::kGrid);
    if (lookup.fault != LookupFault::kNone) {
      result->outcome = Outcome::kOutsideDomain;
      result->joint = lookup.axis;
      return false;
    }
    Motions motions;
    SetMotions(table_.arm.nominal, q_chain.data(), &motions);
    X_nominal_ = Forward(table_.arm.nominal, motions);
    X_corrected_ = CorrectedFlange(table_, motions, lookup.delta);
    remainder_ = Remainder(X_target_, X_corrected_);
    result->position_error_m = remainder_.head<3>().norm();
    result->rotation_error_rad = remainder_.tail<3>().norm();
    return true;
  }

  const Table& table_;
  const double* start_;
  const TableTolerance tolerance_;
  LeastSquaresTask task_;
  Pose X_target_, X_nominal_, X_corrected_;
  Twist remainder_;
  double error_ = 0;      // before correction, rad: lengths over the characteristic one
  bool settled_ = false;  // whether the last joints are the end of a search
};

// The target's own joints, and why.
Correction Refusal(const Table& table, const double* q, Outcome outcome, int joint) {
  Correction result;
  result.outcome = outcome;
  result.joint = joint;
  std::copy_n(q, table.header.joints, result.q.data());
  return result;
}

void CheckLimits(const Arm& arm, Correction* result) {
  if (result->outcome != Outcome::kOk) return;
  result->joint = BeyondLimit(arm, result->q.data());
  if (result->joint >= 0) result->outcome = Outcome::kBeyondLimit;
}

void FillReached(const Table& table, const TableChord& chord, Correction* result) {
  result->outcome = Outcome::kOk;
  result->iterations = chord.iterations;
  result->position_error_m = chord.remainder.head<3>().norm();
  result->rotation_error_rad = chord.remainder.tail<3>().norm();
  if (table.plain_joints) {
    result->q = chord.q_chain;
  } else {
    ControllerJoints(table, chord.q_chain.data(), result->q.data());
  }
}

// @returns false when the slow way is to look at it.
bool CorrectFast(const Table& table, const double* q, TableChord* chord, Correction* result) {
  switch (CorrectByChords(table, chord)) {
    case ChordEnd::kReached:
      FillReached(table, *chord, result);
      return true;
    case ChordEnd::kOutside:
      *result = Refusal(table, q, Outcome::kOutsideDomain, chord->axis);
      return true;
    default:
      return false;
  }
}

}  // namespace

Correction CorrectByTable(const Table& table, const double* q_controller) noexcept {
  TableChord chord;
  ChainJoints(table, q_controller, chord.q_chain.data());
  const Lookup lookup = LookUp(table, chord.q_chain.data(), Reach::kDomain);
  if (table.arm.measuring || lookup.fault == LookupFault::kNotFinite) return {};
  if (lookup.fault == LookupFault::kOutside)
    return Refusal(table, q_controller, Outcome::kOutsideDomain, lookup.axis);
  chord.delta = lookup.delta;
  Correction result;
  if (table.header.joints != 6 || !CorrectFast(table, q_controller, &chord, &result)) {
    result = TableSlowWay(table, q_controller, lookup.delta).Correct();
    if (result.outcome == Outcome::kOutsideDomain)
      return Refusal(table, q_controller, result.outcome, result.joint);
  }
  CheckLimits(table.arm, &result);
  return result;
}

Tip TipByTable(const Table& table, const double* q_controller, const Pose& X_FT,
               const Eigen::Vector3d& axis_T) noexcept {
  Tip tip;
  JointArray q_chain;
  ChainJoints(table, q_controller, q_chain.data());
  const Lookup lookup = LookUp(table, q_chain.data(), Reach::kDomain);
  if (lookup.fault == LookupFault::kNotFinite || !IsPose(X_FT) || !axis_T.allFinite()) return tip;
  tip.outcome = lookup.fault == LookupFault::kNone ? Outcome::kOk : Outcome::kOutsideDomain;
  if (tip.outcome != Outcome::kOk) return tip;
  Motions motions;
  SetMotions(table.arm.nominal, q_chain.data(), &motions);
  tip.X_BT = CorrectedFlange(table, motions, lookup.delta) * X_FT;
  tip.axis_B = tip.X_BT.R * axis_T;
  return tip;
}

}  // namespace truepose::compensation
