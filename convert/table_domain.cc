#include "convert/table_domain.h"

#include <string>

#include "convert/box_domain.h"
#include "convert/robot.h"
#include "convert/table_spec.h"
#include "core/base/status_macros.h"
#include "core/compensation/arm_from.h"
#include "core/compensation/table_domain.h"
#include "core/models/build_model.h"

namespace truepose::convert {
namespace {

// Nothing identified yet: both its chains are the nominal one.
absl::StatusOr<compensation::Arm> NominalArmFrom(const v1::Nominal& nominal) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(nominal));
  TRUEPOSE_ASSIGN_OR_RETURN(const Model model,
                            BuildModel("modified_incremental", robot, ModelExtent::kInternal));
  TRUEPOSE_ASSIGN_OR_RETURN(
      compensation::Arm arm,
      ArmFrom(robot, model, Eigen::VectorXd::Zero(static_cast<int>(model.parameters.size()))));
  arm.measuring = nominal.kind() == v1::MEASURING;
  return arm;
}

}  // namespace

absl::Status CheckTableDomain(const v1::Nominal& nominal, const v1::CompensationTableSpec& spec) {
  TRUEPOSE_RETURN_IF_ERROR(ValidateTableSpec(nominal, spec));
  TRUEPOSE_ASSIGN_OR_RETURN(const compensation::Arm arm, NominalArmFrom(nominal));
  TRUEPOSE_ASSIGN_OR_RETURN(const TableSpec of_core,
                            TableSpecFrom(nominal, CompleteTableSpec(spec)));
  return DomainOf(arm, of_core).status();
}

}  // namespace truepose::convert
