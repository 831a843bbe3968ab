// What a table will be, before it is built.
#pragma once

#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "core/compensation/table_grid.h"

namespace truepose {

struct TableEstimate {
  std::vector<int> nodes;  // of each coordinate; 1 where it is folded
  int64_t bytes = 0;       // of the file
  compensation::PoseError error;
  // Of a box: drawn poses, and those of them that the configuration does not reach.
  int poses = 0, unreachable = 0;
};

// All that building needs to know of an arm and a spec.
struct TablePlan {
  TableDomain domain;
  std::vector<bool> folded;
  ToleranceUnits units;
  std::vector<Curvature> curvatures;
};

// Domain, folded coordinates (their ranges widened to what the limits allow), margins, curvatures.
// @returns the errors of Validate and DomainOf; kFailedPrecondition with a fault when the
//   correction is not finite within the domain.
absl::StatusOr<TablePlan> PlanTable(const compensation::Arm& arm, const TableSpec& spec);

// @param share of the tolerances that interpolation may take (ChooseNodes).
TableEstimate EstimateOf(const TablePlan& plan, double share);

// OK, or kFailedPrecondition with a fault of `largest_bytes` that names the size, the nodes and the
// tolerance at which it would fit.
absl::Status CheckSize(const TableEstimate& estimate, const TablePlan& plan, const TableSpec& spec);

// PlanTable, EstimateOf and CheckSize, without building anything: takes some 0.1 s.
absl::StatusOr<TableEstimate> EstimateTable(const compensation::Arm& arm, const TableSpec& spec);

// The share with which building starts: what verification finds is stated with a margin
// (build_table.h), and this leaves room for it.
inline constexpr double kFirstShare = 0.9;

}  // namespace truepose
