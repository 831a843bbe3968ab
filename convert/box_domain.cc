#include "convert/box_domain.h"

#include "convert/robot.h"
#include "convert/table_spec.h"
#include "core/base/status_macros.h"

namespace truepose::convert {

absl::StatusOr<BoxDomain> BoxFrom(const v1::Nominal& nominal, const v1::BoxDomain& box) {
  BoxDomain domain;
  domain.box_B = {Eigen::Vector3d(box.min_x_m(), box.min_y_m(), box.min_z_m()),
                  Eigen::Vector3d(box.max_x_m(), box.max_y_m(), box.max_z_m())};
  if (!box.tool().empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(domain.X_FT, ToolByName(nominal, box.tool(), "box.tool"));
  }
  const Eigen::Vector3d approach(box.approach_x(), box.approach_y(), box.approach_z());
  if (!approach.isZero(0)) domain.approach_B = approach;
  domain.cone_rad = box.cone_rad();
  if (box.min_roll_rad() != 0 || box.max_roll_rad() != 0) {
    domain.roll_lower_rad = box.min_roll_rad();
    domain.roll_upper_rad = box.max_roll_rad();
  }
  domain.reference =
      Eigen::Map<const Eigen::VectorXd>(box.reference_joints().data(), box.reference_joints_size());
  return domain;
}

absl::StatusOr<TableSpec> TableSpecFrom(const v1::Nominal& nominal,
                                        const v1::CompensationTableSpec& message) {
  TRUEPOSE_RETURN_IF_ERROR(ValidateTableSpec(nominal, message));
  TableSpec spec;
  if (message.has_box()) {
    TRUEPOSE_ASSIGN_OR_RETURN(spec.box, BoxFrom(nominal, message.box()));
  }
  for (const v1::JointRange& range : message.joint_ranges().joints())
    spec.ranges.push_back({range.lower(), range.upper()});
  spec.position_tolerance_m = message.position_tolerance_m();
  spec.rotation_tolerance_rad = message.rotation_tolerance_rad();
  spec.smallest_singular_value = message.smallest_singular_value();
  spec.verification_points = message.verification_points();
  spec.largest_bytes = message.largest_bytes();
  spec.seed = message.seed();
  return spec;
}

}  // namespace truepose::convert
