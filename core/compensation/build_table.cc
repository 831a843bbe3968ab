#include "core/compensation/build_table.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_format.h"
#include "compensation/lookup.h"
#include "compensation/singularity.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/compensation/table_nodes.h"

namespace truepose {
namespace {

using compensation::Arm;
using compensation::PoseError;
using compensation::TableContent;

// The estimate is right to a few per cent, so the second round is the last but for oddities.
constexpr int kMostRounds = 6;
constexpr double kTowards = 0.95;                // of the tolerance, in a further round
constexpr double kPlanned = 0.1, kFilled = 0.5;  // shares of the progress

TableContent Empty(const Arm& arm, const TableSpec& spec, const TableLabels& labels) {
  TableContent content;
  content.arm = arm;
  compensation::TableHeader& header = content.header;
  header.robot = labels.robot;
  header.serial = labels.serial;
  header.calibration = labels.calibration;
  header.calibration_digest = labels.calibration_digest;
  header.nominal_digest = labels.nominal_digest;
  header.created_us = labels.created_us;
  header.joints = arm.nominal.joints;
  header.tolerance = {spec.position_tolerance_m, spec.rotation_tolerance_rad};
  header.smallest_singular_value = spec.smallest_singular_value;
  header.characteristic_length_m = compensation::CharacteristicLength(arm.nominal);
  return content;
}

void SetAxes(const TableDomain& domain, const std::vector<int>& nodes, TableContent* content) {
  for (int k = 0; k < domain.axes.joints(); ++k) {
    const auto i = static_cast<size_t>(k);
    compensation::TableAxis& axis = content->axis[i];
    for (int j = 0; j < domain.axes.joints(); ++j)
      axis.weight[static_cast<size_t>(j)] = domain.axes.weight()(k, j);
    axis.lower = domain.range[i].lower;
    axis.upper = domain.range[i].upper;
    axis.margin = domain.margin[i];
    axis.nodes = nodes[i];
  }
}

void SetFound(const Verification& verification, const TableEstimate& estimate,
              compensation::TableHeader* header) {
  header->verification_points = static_cast<uint32_t>(verification.points);
  header->worst = {kStatedOverFound * verification.worst.position_m,
                   kStatedOverFound * verification.worst.rotation_rad};
  header->percentile_95 = verification.percentile_95;
  header->estimated_worst = estimate.error;
  header->near_singular_share = verification.NearSingularShare();
}

// Enough drawn points were corrected to say how well.
absl::Status CheckVerified(const Verification& verification, const TableSpec& spec) {
  if (verification.corrected >= spec.verification_points) return absl::OkStatus();
  const auto percent = [&](int count) { return 100.0 * count / std::max(verification.drawn, 1); };
  FaultList faults;
  faults.Add("verification_points",
             absl::StrFormat(
                 "%d of %d drawn points are corrected: %.1f %% are refused near a "
                 "singularity, %.1f %% beyond a joint limit, %.1f %% outside of the "
                 "domain",
                 verification.corrected, verification.drawn, percent(verification.near_singular),
                 percent(verification.beyond_limit), percent(verification.outside_domain)),
             absl::StrFormat("%d corrected ones: a smaller smallest_singular_value, or another "
                             "domain",
                             spec.verification_points));
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

absl::Status NotMet(const PoseError& stated) {
  FaultList faults;
  faults.Add("position_tolerance_m",
             absl::StrFormat("%.3g mm, %.3g deg at best", 1e3 * stated.position_m,
                             stated.rotation_rad * 180 / std::numbers::pi),
             "tolerances above that");
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

// A further round does not take the fraction back.
Hooks NeverBack(const Hooks& hooks) {
  return {[hooks, most = 0.0](Progress progress) mutable {
            most = progress.fraction = std::max(most, progress.fraction);
            hooks.Report(progress);
          },
          hooks.is_cancelled};
}

class Builder {
 public:
  Builder(TablePlan plan, const TableSpec& spec, const Hooks& hooks, TableContent content)
      : plan_(std::move(plan)), spec_(spec), hooks_(NeverBack(hooks)) {
    built_.content = std::move(content);
  }

  absl::StatusOr<BuiltTable> Build() {
    double share = kFirstShare;
    for (int round = 0; round < kMostRounds; ++round) {
      TRUEPOSE_RETURN_IF_ERROR(BuildOnce(share));
      const double excess = plan_.units.SizeOf(Stated());
      if (excess <= 1) return std::move(built_);
      share *= kTowards / excess;
    }
    return NotMet(built_.content.header.worst);
  }

 private:
  absl::Status BuildOnce(double share) {
    built_.estimate = EstimateOf(plan_, share);
    TRUEPOSE_RETURN_IF_ERROR(CheckSize(built_.estimate, plan_, spec_));
    SetAxes(plan_.domain, built_.estimate.nodes, &built_.content);
    TRUEPOSE_RETURN_IF_ERROR(
        FillNodes(plan_.domain.axes, hooks_, kPlanned, kFilled, &built_.content));
    TRUEPOSE_ASSIGN_OR_RETURN(
        built_.verification,
        VerifyTable(compensation::MakeTable(built_.content), built_.content.arm,
                    {spec_.verification_points, spec_.seed + 1, kFilled, 1}, hooks_));
    TRUEPOSE_RETURN_IF_ERROR(CheckVerified(built_.verification, spec_));
    SetFound(built_.verification, built_.estimate, &built_.content.header);
    return absl::OkStatus();
  }

  Twist Stated() const {
    const PoseError& worst = built_.content.header.worst;
    Twist stated = Twist::Zero();
    stated(0) = worst.position_m;
    stated(3) = worst.rotation_rad;
    return stated;
  }

  const TablePlan plan_;
  const TableSpec& spec_;
  const Hooks hooks_;
  BuiltTable built_;
};

}  // namespace

absl::StatusOr<BuiltTable> BuildTable(const Arm& arm, const TableSpec& spec,
                                      const TableLabels& labels, const Hooks& hooks) {
  hooks.Report({"domain", 0});
  TRUEPOSE_ASSIGN_OR_RETURN(TablePlan plan, PlanTable(arm, spec));
  if (hooks.Cancelled()) return absl::CancelledError("cancelled before the table was built");
  return Builder(std::move(plan), spec, hooks, Empty(arm, spec, labels)).Build();
}

}  // namespace truepose
