// Builds compensation tables: from an arm and a spec to nodes, verified by the reader's own way.
//
// Plan (table_plan.h), fill, verify (verify_table.h); when the error that would be stated is above
// a tolerance, again with a finer grid. What is stated is the worst that was found times
// kStatedOverFound: the search looks into the cells with the largest second differences, and the
// error's maximum within a cell lies beside its middle by the third derivative's share of it, a
// relative h delta''' / delta'' of some per cent on such grids.
#pragma once

#include <cstdint>

#include "absl/status/statusor.h"
#include "compensation/table.h"
#include "core/base/hooks.h"
#include "core/compensation/table_plan.h"
#include "core/compensation/verify_table.h"

namespace truepose {

inline constexpr double kStatedOverFound = 1.1;

// Whose table it is. What is predicted of the tool is the caller's to add to the header.
struct TableLabels {
  compensation::Text robot, serial, calibration;
  compensation::Digest calibration_digest{}, nominal_digest{};
  int64_t created_us = 0;
};

struct BuiltTable {
  compensation::TableContent content;
  TableEstimate estimate;
  Verification verification;
};

// Equal inputs give equal content, bit by bit.
// @param hooks stages "domain", "nodes", "verification"; both may be called some hundred times.
// @returns the errors of PlanTable and CheckSize, before anything is built; kCancelled;
//   kFailedPrecondition with a fault when no grid meets the tolerances, or so much of the
//   domain is near singularities that not spec.verification_points drawn points are corrected;
//   kInternal of VerifyTable.
absl::StatusOr<BuiltTable> BuildTable(const compensation::Arm& arm, const TableSpec& spec,
                                      const TableLabels& labels, const Hooks& hooks);

}  // namespace truepose
