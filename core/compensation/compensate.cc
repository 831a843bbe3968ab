#include "core/compensation/compensate.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <optional>

#include "absl/strings/str_format.h"
#include "core/base/random.h"

namespace truepose {
namespace {

using Twist = Eigen::Matrix<double, 6, 1>;

// Damping as a share of the largest diagonal of the normal matrix: directions whose singular value
// is below 1e-6 of the others' are hardly stepped along, so joints do not run away near a
// singularity; elsewhere steps stay Newton's to 1e-12, and what a step lacks the next one makes up.
constexpr double kDamping = 1e-12;
// With fewer than six joints not all six coordinates can be met: position comes first, 1 rad counts
// as 1 mm.
constexpr double kMetresPerRadian = 1e-3;
constexpr double kLongestStep = 0.5;  // rad or m; a start from far away comes in pieces

// An arm has up to 16 configurations; starts that arrive do so within some 15 steps.
constexpr int kMostStarts = 100;
constexpr int kEnoughArrivals = 12;
constexpr int kMostInverseIterations = 50;

// What is left to do at X_BF: displacement of the flange point, and rotation vector, both in B.
Twist Remainder(const Pose& desired, const Pose& X_BF) {
  Twist e;
  e << desired.p - X_BF.p, LogRotation<double>(desired.R * X_BF.R.transpose());
  return e;
}

// The least step of least squares: J'(JJ' + d I)^-1 e where there are joints enough, else (J'J + d
// I)^-1 J'e.
Eigen::VectorXd NewtonStep(const ModelSweep& sweep, const Twist& remainder) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> J(6, sweep.J_joints.cols());
  for (Eigen::Index i = 0; i < J.cols(); ++i)
    J.col(i) = TwistAt(sweep.X_BF.p, sweep.J_joints.col(i));
  Eigen::VectorXd step;
  if (J.cols() >= 6) {
    Eigen::Matrix<double, 6, 6> normal = J * J.transpose();
    normal.diagonal().array() += kDamping * normal.diagonal().maxCoeff();
    step = J.transpose() * normal.ldlt().solve(remainder);
  } else {
    Twist weighted = remainder;
    J.bottomRows<3>() *= kMetresPerRadian;
    weighted.tail<3>() *= kMetresPerRadian;
    Eigen::MatrixXd normal = J.transpose() * J;
    normal.diagonal().array() += kDamping * normal.diagonal().maxCoeff();
    step = normal.ldlt().solve(J.transpose() * weighted);
  }
  const double largest = step.cwiseAbs().maxCoeff();
  if (largest > kLongestStep) step *= kLongestStep / largest;
  return step;
}

absl::Status NotReached(const Compensated& result) {
  return absl::FailedPreconditionError(
      absl::StrFormat("not reached after %d steps, %.3g mm and %.3g deg are left: the target is "
                      "out of reach or near a singularity",
                      result.iterations, 1e3 * result.position_residual_m,
                      result.rotation_residual_rad * 180 / std::numbers::pi));
}

bool WithinLimits(const Robot& robot, const Eigen::VectorXd& q_controller) {
  for (int i = 0; i < robot.joint_count(); ++i) {
    if (q_controller(i) < robot.joints()[i].lower || q_controller(i) > robot.joints()[i].upper)
      return false;
  }
  return true;
}

// Whether a whole turn of a controller joint leaves the chain's pose as it is: it turns revolute
// chain joints by whole turns and moves no prismatic one.
bool WholeTurnIsNoMotion(const Robot& robot, int joint) {
  if (robot.joints()[joint].type != JointType::kRevolute) return false;
  for (int row = 0; row < robot.joint_count(); ++row) {
    const double scale = robot.joint_map().scale(row, joint);
    if (robot.joints()[row].type == JointType::kRevolute ? scale != std::round(scale) : scale != 0)
      return false;
  }
  return true;
}

// Turns such joints to within half a turn of `near`.
Eigen::VectorXd Unwound(const Robot& robot, Eigen::VectorXd q, const Eigen::VectorXd& near) {
  for (int i = 0; i < robot.joint_count(); ++i) {
    if (!WholeTurnIsNoMotion(robot, i)) continue;
    q(i) -= 2 * std::numbers::pi * std::round((q(i) - near(i)) / (2 * std::numbers::pi));
  }
  return q;
}

Eigen::VectorXd DrawJoints(const Robot& robot, Random* random) {
  Eigen::VectorXd q(robot.joint_count());
  for (int i = 0; i < robot.joint_count(); ++i) {
    const Joint& joint = robot.joints()[i];
    const double half = joint.type == JointType::kRevolute ? std::numbers::pi : 1.0;
    const double low = std::isfinite(joint.lower) ? std::max(joint.lower, -half) : -half;
    const double high = std::isfinite(joint.upper) ? std::min(joint.upper, half) : half;
    q(i) = low < high ? random->Uniform(low, high) : robot.MiddleOfLimits()(i);
  }
  return q;
}

}  // namespace

absl::StatusOr<Compensated> SolvePose(const Model& model, const Eigen::VectorXd& lambda,
                                      const Pose& X_BF_desired, const Eigen::VectorXd& q_start,
                                      const CompensationOptions& options) {
  Compensated result;
  result.q = q_start;
  ModelSweep sweep;
  double step_size = std::numeric_limits<double>::infinity();
  for (;; ++result.iterations) {
    RunSweep(model, result.q.data(), lambda.data(), {}, &sweep);
    const Twist remainder = Remainder(X_BF_desired, sweep.X_BF);
    result.position_residual_m = remainder.head<3>().norm();
    result.rotation_residual_rad = remainder.tail<3>().norm();
    if (step_size < options.step_tolerance || result.iterations == options.max_iterations) break;
    const Eigen::VectorXd step = NewtonStep(sweep, remainder);
    step_size = step.cwiseAbs().maxCoeff();
    result.q += step;
  }
  const bool exact = result.position_residual_m <= options.position_tolerance_m &&
                     result.rotation_residual_rad <= options.rotation_tolerance_rad;
  const bool best_fit = result.q.size() < 6 && step_size < 1e-9;
  if (!(exact || best_fit)) return NotReached(result);
  return result;
}

absl::StatusOr<Compensated> CompensateJoints(const Model& model, const Eigen::VectorXd& lambda,
                                             const Eigen::VectorXd& q_target,
                                             const CompensationOptions& options) {
  const Eigen::VectorXd nominal = Eigen::VectorXd::Zero(lambda.size());
  return SolvePose(model, lambda, Forward(model, q_target, nominal), q_target, options);
}

absl::StatusOr<Eigen::VectorXd> NominalInverse(const Robot& robot, const Model& model,
                                               const Pose& X_BF, const Eigen::VectorXd& preferred,
                                               const CompensationOptions& options) {
  CompensationOptions patient = options;
  patient.max_iterations = kMostInverseIterations;
  const Eigen::VectorXd nominal = Eigen::VectorXd::Zero(model.parameters.size());
  Random random(1);
  std::optional<Eigen::VectorXd> best;
  absl::Status last;
  int arrivals = 0;
  for (int start = 0; start < kMostStarts && arrivals < kEnoughArrivals; ++start) {
    const Eigen::VectorXd q0 = start == 0 ? preferred : DrawJoints(robot, &random);
    auto solved = SolvePose(model, nominal, X_BF, robot.joint_map().ToChain(q0), patient);
    if (!solved.ok()) {
      last = solved.status();
      continue;
    }
    const Eigen::VectorXd q = Unwound(robot, robot.joint_map().ToController(solved->q), preferred);
    if (!WithinLimits(robot, q)) continue;
    ++arrivals;
    if (!best || (q - preferred).norm() < (*best - preferred).norm()) best = q;
    if (start == 0) break;
  }
  if (best) return robot.joint_map().ToChain(*best);
  if (last.ok())
    return absl::FailedPreconditionError("every configuration found is beyond a joint limit");
  return last;
}

}  // namespace truepose
