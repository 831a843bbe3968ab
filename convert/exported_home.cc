#include "convert/exported_home.h"

#include <cmath>

#include "convert/calibrated_model.h"
#include "convert/robot.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/export/joint_frames.h"

namespace truepose::convert {
namespace {

using Element = v1::ElementaryTransform;

// As in a compensation: what its own report says must not be applied does not reach a robot.
absl::Status CheckVerdict(const v1::Calibration& calibration) {
  if (calibration.report().verdict() != "do_not_apply") return absl::OkStatus();
  FaultList faults;
  faults.Add("calibration.report.verdict", "do_not_apply", "a calibration that may be applied");
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

absl::StatusOr<CalibratedModel> NominalModel(const Robot& robot) {
  Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.parameters.size());
  return CalibratedModel{std::move(model), std::move(zero)};
}

void AppendConstant(Element::Motion motion, v1::Axis axis, double value, v1::Geometry* geometry) {
  // Rounding of the product of two poses of some metres, where a data sheet has 0.
  if (std::abs(value) < 1e-14) return;
  Element* element = geometry->mutable_chain()->add_elements();
  element->set_motion(motion);
  element->set_axis(axis);
  element->set_constant(value);
}

void AppendPose(const Pose& X, v1::Geometry* geometry) {
  AppendConstant(Element::TRANSLATION, v1::X, X.p.x(), geometry);
  AppendConstant(Element::TRANSLATION, v1::Y, X.p.y(), geometry);
  AppendConstant(Element::TRANSLATION, v1::Z, X.p.z(), geometry);
  const RollPitchYaw angles = RollPitchYawOf(X.R);
  AppendConstant(Element::ROTATION, v1::Z, angles.yaw, geometry);
  AppendConstant(Element::ROTATION, v1::Y, angles.pitch, geometry);
  AppendConstant(Element::ROTATION, v1::X, angles.roll, geometry);
}

}  // namespace

absl::StatusOr<Home> ExportedHome(const v1::Nominal& nominal, const v1::Calibration* calibration,
                                  JointSense sense) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(nominal));
  TRUEPOSE_ASSIGN_OR_RETURN(
      const CalibratedModel calibrated,
      calibration == nullptr ? NominalModel(robot) : CalibratedModelFrom(robot, *calibration));
  if (calibration != nullptr) TRUEPOSE_RETURN_IF_ERROR(CheckVerdict(*calibration));
  return HomeOf(robot, calibrated.model, calibrated.lambda, sense);
}

v1::Geometry GeometryOf(const Home& home, const std::vector<Pose>& frames) {
  v1::Geometry geometry;
  const std::vector<Pose> between = PosesBetween(frames, home.X_BF);
  for (size_t i = 0; i < home.axes.size(); ++i) {
    AppendPose(between[i], &geometry);
    Element* joint = geometry.mutable_chain()->add_elements();
    const bool prismatic = home.axes[i].type == JointType::kPrismatic;
    joint->set_motion(prismatic ? Element::TRANSLATION : Element::ROTATION);
    joint->set_axis(v1::Z);
    joint->set_joint(static_cast<int>(i));
  }
  AppendPose(between.back(), &geometry);
  return geometry;
}

}  // namespace truepose::convert
