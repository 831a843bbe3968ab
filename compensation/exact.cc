#include "compensation/exact.h"

#include <algorithm>
#include <cmath>

#include "compensation/chord.h"
#include "compensation/draws.h"
#include "compensation/effects.h"
#include "compensation/inverse.h"
#include "compensation/least_squares.h"
#include "compensation/singularity.h"
#include "compensation/valid.h"

namespace truepose::compensation {
namespace {

// Where damped steps fail: how many other starts, and how long each may take.
constexpr int kDraws = 100;
constexpr int kMostIterationsOfDraw = 40;
constexpr double kNear = 1;  // rad or characteristic lengths: farther is another configuration

// A step a tenth of what a place at the threshold could ask for is reason to look closer.
double LargestGain(const ExactOptions& options) { return 0.1 / options.singular_threshold; }

double LengthOf(const Arm& arm, const ExactOptions& options) {
  return options.characteristic_length_m > 0 ? options.characteristic_length_m
                                             : CharacteristicLength(arm.nominal);
}

// Corrects one target the slow way.
class SlowWay {
 public:
  // @param q_nominal where the nominal flange is at the pose, or nearest to it.
  SlowWay(const Arm& arm, const Pose& X_BF, const double* q_nominal, const ExactOptions& options)
      : arm_(arm), options_(options), n_(arm.nominal.joints) {
    std::copy_n(q_nominal, n_, q_nominal_.data());
    task_ = TaskOf(arm, arm.identified, X_BF, options);
    MovedJoints(arm, q_nominal, start_.data());
  }

  Correction Solve() {
    LeastSquaresResult solved = SolveFrom(start_.data());
    if (n_ >= 6 && !solved.reached) solved = Elsewhere(solved);
    exists_ = n_ >= 6 ? solved.reached : solved.settled;
    Correction result = CorrectionAt(solved);
    first_beyond_ = BeyondLimit(arm_, result.q.data());
    if (first_beyond_ >= 0) result = Within(result);
    Measure(&result);
    Judge(&result);
    return result;
  }

 private:
  LeastSquaresResult SolveFrom(const double* v) {
    const LeastSquaresResult solved = SolveLeastSquares(task_, v);
    const long free = n_ - std::count(task_.held.begin(), task_.held.begin() + n_, true);
    return solved.reached && free > 6 ? DrawTowards(task_, start_.data(), solved) : solved;
  }

  double DistanceOf(const JointArray& v) const {
    double largest = 0;
    for (int i = 0; i < n_; ++i) {
      const double unit = arm_.nominal.prismatic[i] ? task_.length_m : 1;
      largest = std::max(largest, std::abs(v[i] - start_[i]) / unit);
    }
    return largest;
  }

  // Damped steps may end in a valley beside the solution. Of draws around the start the nearest
  // that arrives, else what there was.
  LeastSquaresResult Elsewhere(const LeastSquaresResult& given) {
    LeastSquaresResult best = given;
    Draws draws(1);
    task_.max_iterations = std::min(options_.max_iterations, kMostIterationsOfDraw);
    for (int draw = 0; draw < kDraws; ++draw) {
      JointArray v = start_;
      for (int i = 0; i < n_; ++i)
        v[i] += (2 * draws.Next() - 1) * (arm_.nominal.prismatic[i] ? 2 * task_.length_m : 1);
      const LeastSquaresResult found = SolveFrom(v.data());
      if (found.reached && (!best.reached || DistanceOf(found.v) < DistanceOf(best.v)))
        best = found;
    }
    task_.max_iterations = options_.max_iterations;
    return best;
  }

  // Joints beyond a limit are held at it, one after the other, and the others make up for them.
  Correction Within(Correction result) {
    for (int beyond = first_beyond_; beyond >= 0 && !task_.held[beyond];
         beyond = BeyondLimit(arm_, result.q.data())) {
      Hold(beyond, &result.q);
      JointArray v;
      MovedJoints(arm_, result.q.data(), v.data());
      const int iterations = result.iterations;
      result = CorrectionAt(SolveFrom(v.data()));
      result.iterations += iterations;
      KeepHeld(&result.q);
    }
    return result;
  }

  // Where no readings move the joints so far there is no solution.
  Correction CorrectionAt(const LeastSquaresResult& solved) {
    Correction result;
    result.iterations = solved.iterations;
    if (!ReadingsOf(arm_, solved.v.data(), result.q.data())) {
      result.q = q_nominal_;
      exists_ = false;
    }
    return result;
  }

  // At its nearer limit from now on.
  void Hold(int joint, JointArray* q) {
    const JointLimits& limits = arm_.limits[joint];
    limit_[joint] = (*q)[joint] < limits.lower ? limits.lower : limits.upper;
    task_.held[joint] = true;
    KeepHeld(q);
  }

  // A held joint's reading is its limit to the bit, which the way back from effects may miss.
  void KeepHeld(JointArray* q) const {
    for (int i = 0; i < n_; ++i) {
      if (task_.held[i]) (*q)[i] = limit_[i];
    }
  }

  void Measure(Correction* result) const {
    const Pose X = IdentifiedFlange(arm_, result->q.data());
    const Twist e = Remainder(task_.desired, X);
    const Eigen::Vector3d& c = task_.point_F;
    result->position_error_m = (e.head<3>() + task_.desired.R * c - X.R * c).norm();
    result->rotation_error_rad = e.tail<3>().norm();
    result->smallest_singular_value = SmallestSingularValue(arm_, result->q.data(), task_.length_m);
  }

  bool IsLargeForItsError(const Correction& result) const {
    JointArray v;
    MovedJoints(arm_, result.q.data(), v.data());
    const Twist e = Remainder(task_.desired, IdentifiedFlange(arm_, q_nominal_.data()));
    return DistanceOf(v) >
           LargestGain(options_) * (e.head<3>().norm() / task_.length_m + e.tail<3>().norm());
  }

  bool IsReached(const Correction& result) const {
    if (n_ < 6) return exists_ && first_beyond_ < 0;
    return result.position_error_m <= options_.position_tolerance_m &&
           result.rotation_error_rad <= options_.rotation_tolerance_rad &&
           BeyondLimit(arm_, result.q.data()) < 0;
  }

  void Judge(Correction* result) const {
    const double nominal = SmallestSingularValue(arm_, q_nominal_.data(), task_.length_m);
    const double nearest = std::min(nominal, result->smallest_singular_value);
    if (IsReached(*result)) {
      // Another configuration is behind a singularity, however far from it both ends are.
      const bool far = nearest < options_.singular_threshold || DistanceOf(result->q) > kNear;
      result->outcome =
          (far || n_ < 6) && IsLargeForItsError(*result) ? Outcome::kNearSingular : Outcome::kOk;
    } else if (exists_ && first_beyond_ >= 0) {
      result->outcome = Outcome::kBeyondLimit;
      result->joint = first_beyond_;
    } else {
      const bool near = n_ < 6 || nominal < options_.singular_threshold;
      result->outcome = near ? Outcome::kNearSingular : Outcome::kUnreachable;
    }
  }

  const Arm& arm_;
  const ExactOptions& options_;
  const int n_;
  JointArray q_nominal_{}, start_{}, limit_{};
  LeastSquaresTask task_;
  bool exists_ = false;    // a solution, within the limits or not
  int first_beyond_ = -1;  // the joint that is beyond its limit at it
};

// The fast way for six joints. @returns false when the slow one is to look at it.
bool SolveFast(const Arm& arm, bool has_effects, const Pose& X_BF, const ExactOptions& options,
               ChordState* state, Correction* result) {
  ChordOptions chords;
  chords.position_tolerance_m = options.position_tolerance_m;
  chords.rotation_tolerance_rad = options.rotation_tolerance_rad;
  chords.characteristic_length_m = LengthOf(arm, options);
  chords.largest_gain = LargestGain(options);
  if (!SolveByChords(arm, X_BF, chords, state)) return false;
  if (!has_effects) {
    result->q = state->v;
  } else if (!ReadingsOf(arm, state->v.data(), result->q.data())) {
    return false;
  }
  if (BeyondLimit(arm, result->q.data()) >= 0) return false;
  result->outcome = Outcome::kOk;
  result->iterations = state->iterations;
  result->position_error_m = state->remainder.head<3>().norm();
  result->rotation_error_rad = state->remainder.tail<3>().norm();
  return true;
}

// v and motions of the identified chain at controller joints q.
void StartAt(const Arm& arm, const double* q, ChordState* state) {
  JointArray q_chain;
  MovedJoints(arm, q, state->v.data());
  ToChain(arm, state->v.data(), q_chain.data());
  SetMotions(arm.identified, q_chain.data(), &state->motions);
}

bool SolveFastFrom(const Arm& arm, const Pose& X_BF, const double* q, const ExactOptions& options,
                   Correction* result) {
  if (arm.nominal.joints != 6) return false;
  ChordState state;
  StartAt(arm, q, &state);
  return SolveFast(arm, HasEffects(arm), X_BF, options, &state, result);
}

// What not even the nominal arm reaches is no fault of the correction's.
void SayAsNominal(const Arm& arm, const Correction& nominal, const ExactOptions& options,
                  Correction* result) {
  const bool missed =
      arm.nominal.joints < 6 && nominal.position_error_m > options.largest_position_miss_m;
  if (result->outcome == Outcome::kOk && !missed) return;
  if (nominal.outcome == Outcome::kOk && !missed) return;
  if (arm.nominal.joints >= 6 && result->position_error_m <= options.position_tolerance_m &&
      result->rotation_error_rad <= options.rotation_tolerance_rad)
    return;  // reached all the same
  const bool limit = nominal.outcome == Outcome::kBeyondLimit;
  result->outcome = limit ? nominal.outcome : Outcome::kUnreachable;
  result->joint = limit ? nominal.joint : -1;
}

}  // namespace

LeastSquaresTask TaskOf(const Arm& arm, const JointChain& chain, const Pose& X_BF,
                        const ExactOptions& options) noexcept {
  LeastSquaresTask task;
  task.arm = &arm;
  task.chain = &chain;
  task.desired = X_BF;
  task.length_m = LengthOf(arm, options);
  task.position_tolerance_m = options.position_tolerance_m;
  task.rotation_tolerance_rad = options.rotation_tolerance_rad;
  task.max_iterations = options.max_iterations;
  if (arm.nominal.joints < 6) {
    task.point_F = options.point_F;
    task.weight = Eigen::Map<const Twist>(options.weight.data());
  } else {
    task.weight.head<3>().setConstant(1 / task.length_m);
  }
  return task;
}

Correction CorrectJoints(const Arm& arm, const double* q_controller,
                         const ExactOptions& options) noexcept {
  Correction result;
  if (arm.measuring || !AreJoints(arm, q_controller)) return result;
  JointArray q_chain;
  ToChain(arm, q_controller, q_chain.data());
  Motions motions;
  SetMotions(arm.nominal, q_chain.data(), &motions);
  const Pose X_BF = Forward(arm.nominal, motions);
  if (arm.nominal.joints == 6) {
    ChordState state;
    std::copy_n(q_controller, 6, state.v.data());
    state.motions = motions;  // without effects the sines of both chains are the same
    const bool has_effects = HasEffects(arm);
    if (has_effects) StartAt(arm, q_controller, &state);
    if (SolveFast(arm, has_effects, X_BF, options, &state, &result)) return result;
  }
  return SlowWay(arm, X_BF, q_controller, options).Solve();
}

Correction CorrectPose(const Arm& arm, const Pose& X_BF, const double* q_seed_controller,
                       const ExactOptions& options) noexcept {
  if (arm.measuring || !AreJoints(arm, q_seed_controller) || !IsPose(X_BF)) return {};
  const Correction nominal = NearestBranch(arm, X_BF, q_seed_controller, InverseOptions{options});
  Correction result;
  if (!SolveFastFrom(arm, X_BF, nominal.q.data(), options, &result))
    result = SlowWay(arm, X_BF, nominal.q.data(), options).Solve();
  result.iterations += nominal.iterations;
  SayAsNominal(arm, nominal, options, &result);
  return result;
}

Tip CorrectedTip(const Arm& arm, const double* q_controller, const Pose& X_FT,
                 const Eigen::Vector3d& axis_T) noexcept {
  Tip tip;
  if (!AreJoints(arm, q_controller) || !IsPose(X_FT) || !axis_T.allFinite()) return tip;
  tip.outcome = Outcome::kOk;
  tip.X_BT = IdentifiedFlange(arm, q_controller) * X_FT;
  tip.axis_B = tip.X_BT.R * axis_T;
  return tip;
}

}  // namespace truepose::compensation
