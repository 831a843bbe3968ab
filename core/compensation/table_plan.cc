#include "core/compensation/table_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "compensation/table_layout.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose {
namespace {

using compensation::Arm;

constexpr double kMegabyte = 1 << 20;
constexpr double kMostBytes = 1e18;  // what an integer holds; such tables are refused
constexpr double kMostLoosening = 1e6;

// The domain with its folded coordinates as wide as the limits allow.
TableDomain Widened(const Arm& arm, const TableDomain& domain, const std::vector<bool>& folded) {
  TableDomain wide = domain;
  for (int k = 0; k < domain.axes.joints(); ++k)
    if (folded[static_cast<size_t>(k)])
      wide.range[static_cast<size_t>(k)] = WidestRange(arm, domain.axes, k);
  return wide;
}

// Of a box: what does not matter within its narrow range may do so farther out. Then the
// coordinate is given nodes, and the narrow range back.
std::vector<bool> FoldAndWiden(const Arm& arm, const TableSpec& spec, const ToleranceUnits& units,
                               TableDomain* domain) {
  const TableDomain narrow = *domain;
  std::vector<bool> folded = FoldedAxes(arm, narrow, units, spec.seed);
  if (!spec.box) return folded;
  for (bool changed = true; changed;) {
    *domain = Widened(arm, narrow, folded);
    const std::vector<bool> still = FoldedAxes(arm, *domain, units, spec.seed);
    changed = false;
    for (size_t k = 0; k < folded.size(); ++k) {
      if (!folded[k] || still[k]) continue;
      folded[k] = false;
      changed = true;
    }
  }
  return folded;
}

bool Finite(const std::vector<Curvature>& curvatures) {
  for (const Curvature& curvature : curvatures)
    for (const Twist& twist : curvature)
      if (!twist.allFinite()) return false;
  return true;
}

// By how much both tolerances must grow: error goes with the square of the steps, the number of
// nodes with their inverse in each unfolded coordinate.
double Loosening(const TableEstimate& estimate, const TableSpec& spec) {
  const auto axes =
      std::count_if(estimate.nodes.begin(), estimate.nodes.end(), [](int n) { return n > 1; });
  const double larger =
      static_cast<double>(estimate.bytes) / static_cast<double>(spec.largest_bytes);
  return std::pow(larger, 2.0 / static_cast<double>(std::max<ptrdiff_t>(axes, 1)));
}

// Upwards, to two digits, as it is told.
double Rounded(double value) {
  const double digit = std::pow(10, std::floor(std::log10(value)) - 1);
  return digit * std::ceil(value / digit * (1 - 1e-12));
}

bool Fits(const TablePlan& plan, const TableSpec& spec, const ToleranceUnits& units) {
  TablePlan other = plan;
  other.units = units;
  return EstimateOf(other, kFirstShare).bytes <= spec.largest_bytes;
}

constexpr double kMmPerM = 1e3, kDegPerRad = 180 / std::numbers::pi;

ToleranceUnits Times(const ToleranceUnits& units, double position, double rotation) {
  return {Rounded(units.position_m * kMmPerM * position) / kMmPerM,
          Rounded(units.rotation_rad * kDegPerRad * rotation) / kDegPerRad};
}

// Tolerances as they are told with which the table would fit, larger only where that is needed.
ToleranceUnits TolerancesThatFit(const TableEstimate& estimate, const TablePlan& plan,
                                 const TableSpec& spec) {
  double factor = Loosening(estimate, spec);
  while (!Fits(plan, spec, Times(plan.units, factor, factor)) && factor < kMostLoosening)
    factor *= 1.05;
  ToleranceUnits units = Times(plan.units, factor, factor);
  for (const ToleranceUnits& one : {ToleranceUnits{units.position_m, plan.units.rotation_rad},
                                    ToleranceUnits{plan.units.position_m, units.rotation_rad}}) {
    if (Fits(plan, spec, one)) return one;
  }
  return units;
}

}  // namespace

absl::StatusOr<TablePlan> PlanTable(const Arm& arm, const TableSpec& spec) {
  TRUEPOSE_ASSIGN_OR_RETURN(TableDomain domain, DomainOf(arm, spec));
  const ToleranceUnits units{spec.position_tolerance_m, spec.rotation_tolerance_rad};
  std::vector<bool> folded = FoldAndWiden(arm, spec, units, &domain);
  domain.margin = MarginsOf(arm, domain, spec);
  std::vector<Curvature> curvatures = CurvaturesOf(arm, domain, folded, spec.seed);
  if (!Finite(curvatures)) {
    FaultList faults;
    faults.Add("calibration", "corrections that are not finite", "a calibration of this robot");
    return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
  }
  return TablePlan{std::move(domain), std::move(folded), units, std::move(curvatures)};
}

TableEstimate EstimateOf(const TablePlan& plan, double share) {
  TableEstimate estimate;
  estimate.nodes = ChooseNodes(plan.domain, plan.folded, plan.curvatures, plan.units, share);
  const double bytes = compensation::kNodesAt +
                       NodeCount(estimate.nodes) * compensation::kNodeFloats * sizeof(float);
  estimate.bytes = static_cast<int64_t>(std::min(bytes, kMostBytes));
  estimate.error = ErrorOf(plan.domain, estimate.nodes, plan.curvatures);
  estimate.poses = plan.domain.poses;
  estimate.unreachable = plan.domain.unreachable;
  return estimate;
}

absl::Status CheckSize(const TableEstimate& estimate, const TablePlan& plan,
                       const TableSpec& spec) {
  if (estimate.bytes <= spec.largest_bytes) return absl::OkStatus();
  const ToleranceUnits units = TolerancesThatFit(estimate, plan, spec);
  FaultList faults;
  faults.Add("largest_bytes",
             absl::StrFormat("a table of %.4g MB with %s nodes",
                             static_cast<double>(estimate.bytes) / kMegabyte,
                             absl::StrJoin(estimate.nodes, " x ")),
             absl::StrFormat("at most %.4g MB: loosen the tolerances to %.2g mm and %.2g deg, "
                             "or narrow the joint ranges or the box",
                             static_cast<double>(spec.largest_bytes) / kMegabyte,
                             kMmPerM * units.position_m, kDegPerRad * units.rotation_rad));
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

absl::StatusOr<TableEstimate> EstimateTable(const Arm& arm, const TableSpec& spec) {
  TRUEPOSE_ASSIGN_OR_RETURN(const TablePlan plan, PlanTable(arm, spec));
  const TableEstimate estimate = EstimateOf(plan, kFirstShare);
  TRUEPOSE_RETURN_IF_ERROR(CheckSize(estimate, plan, spec));
  return estimate;
}

}  // namespace truepose
