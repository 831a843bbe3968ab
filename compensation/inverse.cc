#include "compensation/inverse.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compensation/draws.h"
#include "compensation/spherical_wrist.h"
#include "compensation/turns.h"
#include "compensation/valid.h"

namespace truepose::compensation {
namespace {

// Two solutions nearer than this are one: a double root is right to the root of the last bit.
constexpr double kSame = 1e-5;
// With fewer than six joints: remainders this near to the least count as the same.
constexpr double kSameCost = 1e-8;

// Collects branches, nearest to the reference first, each once.
class Collector {
 public:
  Collector(const Arm& arm, const LeastSquaresTask& task, const double* q_reference,
            Branches* branches)
      : arm_(arm), task_(task), q_reference_(q_reference), n_(arm.nominal.joints), all_(*branches) {
    ToChain(arm, q_reference, chain_reference_.data());
  }

  // From controller joints near a solution. @returns whether a branch, new or known, was reached.
  bool Try(const double* q_start) {
    LeastSquaresResult found = SolveLeastSquares(task_, q_start);
    iterations_ += found.iterations;
    JointArray q = found.v;
    const int beyond = UnwindToReference(&q);
    if (found.reached && n_ > 6) {
      found = DrawTowards(task_, q_reference_, {.v = q, .reached = true, .settled = true});
      q = found.v;
    }
    KeepBest(found, q, beyond);
    if (n_ < 6 ? !IsLeast(found) : !found.reached) return false;
    const int joint = n_ > 6 ? UnwindToReference(&q) : beyond;
    if (joint >= 0) {
      if (all_.joint < 0) all_.joint = joint;
      return true;
    }
    Insert(q);
    return true;
  }

  int iterations() const { return iterations_; }

  double DistanceOf(const JointArray& q) const {
    double sum = 0;
    for (int i = 0; i < n_; ++i) {
      const double away =
          (q[i] - q_reference_[i]) / (arm_.nominal.prismatic[i] ? task_.length_m : 1);
      sum += away * away;
    }
    return std::sqrt(sum);
  }

 private:
  int UnwindToReference(JointArray* q) const {
    JointArray q_chain;
    ToChain(arm_, q->data(), q_chain.data());
    UnwindChain(arm_.nominal, chain_reference_.data(), q_chain.data());
    ToController(arm_, q_chain.data(), q->data());
    return Unwind(arm_, q_reference_, q->data());
  }

  // A smaller remainder than all before makes those none.
  bool IsLeast(const LeastSquaresResult& found) {
    if (!found.settled) return false;
    if (found.cost < least_cost_ - kSameCost) {
      all_.count = 0;
      all_.joint = -1;
    }
    least_cost_ = std::min(least_cost_, found.cost);
    return found.cost <= least_cost_ + kSameCost;
  }

  // The reached ones first, then the one that comes nearest.
  void KeepBest(const LeastSquaresResult& found, const JointArray& q, int beyond) {
    if (has_best_ && found.cost >= best_cost_) return;
    has_best_ = true;
    best_cost_ = found.cost;
    all_.best.q = q;
    all_.best.joint = beyond;
    all_.best.position_error_m = found.position_error_m;
    all_.best.rotation_error_rad = found.rotation_error_rad;
  }

  bool IsSame(const JointArray& a, const JointArray& b) const {
    for (int i = 0; i < n_; ++i) {
      const double unit = arm_.nominal.prismatic[i] ? task_.length_m : 1;
      const double period = WholeTurnIsNoMotion(arm_, i) ? 2 * std::numbers::pi : 1e300;
      if (std::abs(std::remainder(a[i] - b[i], period)) > kSame * unit) return false;
    }
    return true;
  }

  void Insert(const JointArray& q) {
    for (int i = 0; i < all_.count; ++i) {
      if (IsSame(all_.q[i], q)) return;
    }
    int place = std::min(all_.count, kMaxBranches - 1);
    if (all_.count == kMaxBranches && DistanceOf(q) >= DistanceOf(all_.q[place])) return;
    for (; place > 0 && DistanceOf(all_.q[place - 1]) > DistanceOf(q); --place)
      all_.q[place] = all_.q[place - 1];
    all_.q[place] = q;
    all_.count = std::min(all_.count + 1, kMaxBranches);
  }

  const Arm& arm_;
  const LeastSquaresTask& task_;
  const double* q_reference_;
  const int n_;
  Branches& all_;
  JointArray chain_reference_{};
  double least_cost_ = 1e300, best_cost_ = 0;
  bool has_best_ = false;
  int iterations_ = 0;
};

void TryClosedForm(const Arm& arm, const SphericalWrist& wrist, const Pose& X_BF,
                   const double* q_reference, Collector* collector) {
  JointArray reference;
  ToChain(arm, q_reference, reference.data());
  const WristBranches candidates = WristCandidates(arm.nominal, wrist, X_BF, reference.data());
  for (int i = 0; i < candidates.count; ++i) {
    JointArray q;
    ToController(arm, candidates.q[i].data(), q.data());
    collector->Try(q.data());
  }
}

void TryDraws(const Arm& arm, double length_m, const InverseOptions& options,
              Collector* collector) {
  Draws draws(options.seed);
  for (int start = 0; start < options.starts; ++start) {
    JointArray q;
    draws.Joints(arm, length_m, q.data());
    collector->Try(q.data());
  }
}

// A branch with the errors that are left at it.
Correction Reached(const Arm& arm, const LeastSquaresTask& task, const JointArray& q) {
  const Pose X = NominalFlange(arm, q.data());
  const Twist e = Remainder(task.desired, X);
  const Eigen::Vector3d& c = task.point_F;
  Correction result;
  result.outcome = Outcome::kOk;
  result.q = q;
  result.position_error_m = (e.head<3>() + task.desired.R * c - X.R * c).norm();
  result.rotation_error_rad = e.tail<3>().norm();
  return result;
}

}  // namespace

Branches AllBranches(const Arm& arm, const Pose& X_BF, const double* q_reference,
                     const InverseOptions& options) noexcept {
  Branches branches;
  if (!AreJoints(arm, q_reference) || !IsPose(X_BF)) return branches;
  const LeastSquaresTask task = TaskOf(arm, arm.nominal, X_BF, options);
  const SphericalWrist wrist = SphericalWristOf(arm.nominal);
  Collector collector(arm, task, q_reference, &branches);
  branches.closed_form = wrist.is_one;
  if (wrist.is_one) TryClosedForm(arm, wrist, X_BF, q_reference, &collector);
  // Where the closed form has nothing Newton says how near the arm comes.
  if (!wrist.is_one || branches.count == 0) collector.Try(q_reference);
  if (!wrist.is_one) TryDraws(arm, task.length_m, options, &collector);
  branches.best.iterations = collector.iterations();
  branches.outcome = branches.count > 0    ? Outcome::kOk
                     : branches.joint >= 0 ? Outcome::kBeyondLimit
                                           : Outcome::kUnreachable;
  return branches;
}

Correction NearestBranch(const Arm& arm, const Pose& X_BF, const double* q_seed,
                         const InverseOptions& options) noexcept {
  if (!AreJoints(arm, q_seed) || !IsPose(X_BF)) return {};
  const LeastSquaresTask task = TaskOf(arm, arm.nominal, X_BF, options);
  Branches near;
  Collector collector(arm, task, q_seed, &near);
  if (arm.nominal.joints >= 6 && collector.Try(q_seed) && near.count == 1 &&
      collector.DistanceOf(near.q[0]) <= options.near)
    return Reached(arm, task, near.q[0]);
  const Branches all = AllBranches(arm, X_BF, q_seed, options);
  if (all.outcome == Outcome::kOk) return Reached(arm, task, all.q[0]);
  Correction result = all.best;
  result.outcome = all.outcome;
  if (all.outcome == Outcome::kBeyondLimit) result.joint = all.joint;
  return result;
}

}  // namespace truepose::compensation
