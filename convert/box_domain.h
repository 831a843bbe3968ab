// What a table or an accuracy map is asked to cover, for the core.
#pragma once

#include "absl/status/statusor.h"
#include "core/compensation/table_spec.h"
#include "truepose/v1/compensation_table_spec.pb.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::convert {

// @param spec completed (table_spec.h). @returns the faults of ValidateTableSpec.
absl::StatusOr<TableSpec> TableSpecFrom(const v1::Nominal& nominal,
                                        const v1::CompensationTableSpec& spec);

// @pre ValidateTableSpec accepts a spec with this box; no approach = straight down.
absl::StatusOr<BoxDomain> BoxFrom(const v1::Nominal& nominal, const v1::BoxDomain& box);

}  // namespace truepose::convert
