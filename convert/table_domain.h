// Whether a compensation table can be built as asked for, as far as the nominal robot tells: before
// there is any calibration.
#pragma once

#include "absl/status/status.h"
#include "truepose/v1/compensation_table_spec.pb.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::convert {

// The domain as building finds it, on the nominal chain: reference joints within the limits,
// prismatic joints with a range, a box of which something is reached. Takes some 0.05 s, and some
// 0.3 s to find out that nothing is.
// @returns every fault of ValidateTableSpec (table_spec.h), else kInvalidArgument with those of the
//   domain; kFailedPrecondition with a fault `box` when nothing of it is reached. RobotFrom's for a
//   nominal that is no robot.
absl::Status CheckTableDomain(const v1::Nominal& nominal, const v1::CompensationTableSpec& spec);

}  // namespace truepose::convert
