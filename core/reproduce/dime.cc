#include "core/reproduce/dime.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/status_macros.h"
#include "core/identification/prediction.h"
#include "core/reproduce/measuring_robot.h"

namespace truepose {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Nominal geometry of Eq. 37, m.
constexpr double kShoulderHeight = .252, kUpperArm = .320, kForearm = .330, kPin = .161;

// Direction of a pin that points down, leaning `outward` away from the robot or `sideways`.
Eigen::Vector3d Direction(const Eigen::Vector3d& site, double outward, double sideways) {
  const Eigen::Vector3d out = Eigen::Vector3d(site.x(), site.y(), 0).normalized();
  const Eigen::Vector3d left(-out.y(), out.x(), 0);
  return (std::sin(outward) * out + std::sin(sideways) * left -
          std::cos(outward) * std::cos(sideways) * Eigen::Vector3d::UnitZ())
      .normalized();
}

void AppendSite(const Eigen::Vector3d& site, double lean, double side,
                std::vector<DimePose>* poses) {
  for (const auto& [outward, sideways] :
       {std::pair{0.0, 0.0}, {-lean, 0.0}, {lean, 0.0}, {0.0, side}})
    poses->push_back({{site, Direction(site, outward, sideways)}, false});
}

// Joints 2 and 3 that put the wrist at horizontal distance r and height z over the shoulder.
absl::StatusOr<Eigen::Vector2d> Elbow(double r, double z) {
  const double c =
      (r * r + z * z - kUpperArm * kUpperArm - kForearm * kForearm) / (2 * kUpperArm * kForearm);
  if (std::abs(c) > 1) return absl::FailedPreconditionError("the hole is out of reach");
  const double q3 = -std::acos(c);
  const double q2 =
      std::atan2(z, r) - std::atan2(kForearm * std::sin(q3), kUpperArm + kForearm * std::cos(q3));
  return Eigen::Vector2d(q2, q3);
}

// Joints 4 and 5 that turn the pin to a direction t, given in frame 3 of the arm.
Eigen::Vector2d Wrist(const Eigen::Vector3d& t, bool flipped) {
  const double q5 = -std::asin(std::clamp(t.z(), -1.0, 1.0));
  if (flipped) return {std::atan2(t.y(), t.x()), std::numbers::pi - q5};
  return {std::atan2(-t.y(), -t.x()), q5};
}

Reading ReadingOf(const Hole& hole, const Eigen::VectorXd& q) {
  Reading reading;
  reading.kind = ObservationKind::kPointAxis;
  reading.X_MT.p = hole.p_M;
  reading.axis_M = hole.axis_M;
  reading.q = q;
  return reading;
}

}  // namespace

std::vector<DimePose> Dime() {
  std::vector<DimePose> poses;
  double side = 40 * kDegree;
  for (double z : {.060, .170}) {
    for (double y : {-.180, 0.0, .180}) {
      for (double x : {.360, .450, .540}) {
        AppendSite({x, y, z}, (z < .1 ? 15 : 20) * kDegree, side, &poses);
        side = -side;
      }
    }
  }
  // Every eighth hole would always be the same of a site's four.
  for (size_t i = 0; i < 9; ++i) poses.push_back({poses[8 * i + i % 4].hole, true});
  return poses;
}

absl::StatusOr<Eigen::VectorXd> NominalJoints(const DimePose& pose) {
  const Eigen::Vector3d wrist = pose.hole.p_M - kPin * pose.hole.axis_M;
  Eigen::VectorXd q(kMeasuringRobotJoints);
  q(0) = std::atan2(wrist.y(), wrist.x());
  TRUEPOSE_ASSIGN_OR_RETURN(q.segment<2>(1),
                            Elbow(wrist.head<2>().norm(), wrist.z() - kShoulderHeight));
  // Frame 3: z along the forearm, x across it in the arm's plane, upwards.
  const double rise = q(1) + q(2);
  const Eigen::Vector3d out(std::cos(q(0)), std::sin(q(0)), 0), up = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d R;
  R.col(2) = std::cos(rise) * out + std::sin(rise) * up;
  R.col(0) = -std::sin(rise) * out + std::cos(rise) * up;
  R.col(1) = R.col(2).cross(R.col(0));
  q.tail<2>() = Wrist(R.transpose() * pose.hole.axis_M, pose.flipped);
  return q;
}

absl::StatusOr<Eigen::VectorXd> JointsAt(const Model& measuring_robot,
                                         const Eigen::VectorXd& lambda, const DimePose& pose) {
  constexpr int kMostSteps = 30;
  constexpr double kArrived = 1e-12;  // rad; the last step of a quadratic convergence
  TRUEPOSE_ASSIGN_OR_RETURN(const Eigen::VectorXd start, NominalJoints(pose));
  Reading reading = ReadingOf(pose.hole, start);
  const Problem problem = MeasuringRobotProblem(measuring_robot, {});
  Estimate estimate = NominalEstimate(problem);
  estimate.lambda = lambda;
  Workspace workspace;
  for (int i = 0; i < kMostSteps; ++i) {
    const Eigen::MatrixXd J = JointJacobian(problem, reading, estimate, &workspace);
    const Eigen::VectorXd step =
        J.partialPivLu().solve(Eigen::VectorXd(-ResidualAt(problem, reading, estimate)));
    if (!step.allFinite()) break;
    reading.q += step;
    if (step.cwiseAbs().maxCoeff() < kArrived) return reading.q;
  }
  return absl::FailedPreconditionError("Newton did not bring the pin into the hole");
}

}  // namespace truepose
