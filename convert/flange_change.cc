#include "convert/flange_change.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "convert/calibrated_model.h"
#include "convert/robot.h"
#include "core/base/random.h"
#include "core/base/status_macros.h"

namespace truepose::convert {
namespace {

constexpr int kConfigurations = 500;

Eigen::VectorXd DrawJoints(const Robot& robot, Random& random) {
  Eigen::VectorXd controller(robot.joint_count());
  for (int i = 0; i < robot.joint_count(); ++i) {
    const Joint& joint = robot.joints()[i];
    const double range = joint.type == JointType::kRevolute ? std::numbers::pi : 0.5;
    controller(i) = random.Uniform(std::max(joint.lower, -range), std::min(joint.upper, range));
  }
  return controller;
}

// Nothing for a calibration that says nothing of the robot itself.
absl::StatusOr<std::optional<CalibratedModel>> ModelOrNominal(const Robot& robot,
                                                              const v1::Calibration& calibration) {
  if (calibration.internal_parameters().empty()) return std::optional<CalibratedModel>();
  TRUEPOSE_ASSIGN_OR_RETURN(CalibratedModel model, CalibratedModelFrom(robot, calibration));
  return std::optional(std::move(model));
}

Eigen::Vector3d Flange(const Robot& robot, const std::optional<CalibratedModel>& model,
                       const Eigen::VectorXd& controller) {
  const Eigen::VectorXd q = robot.joint_map().ToChain(controller);
  if (!model.has_value()) return Forward(robot.chain(), q, Eigen::VectorXd()).p;
  return Forward(model->model, q, model->lambda).p;
}

}  // namespace

absl::StatusOr<double> FlangeChangeMm(const v1::Nominal& nominal, const v1::Calibration& a,
                                      const v1::Calibration& b) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(nominal));
  TRUEPOSE_ASSIGN_OR_RETURN(const auto model_a, ModelOrNominal(robot, a));
  TRUEPOSE_ASSIGN_OR_RETURN(const auto model_b, ModelOrNominal(robot, b));
  Random random(1);
  double largest_m = 0.0;
  for (int i = 0; i < kConfigurations; ++i) {
    const Eigen::VectorXd controller = DrawJoints(robot, random);
    const Eigen::Vector3d change =
        Flange(robot, model_a, controller) - Flange(robot, model_b, controller);
    largest_m = std::max(largest_m, change.norm());
  }
  return 1000.0 * largest_m;
}

}  // namespace truepose::convert
