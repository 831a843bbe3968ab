#include "core/compensation/table_domain.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "absl/strings/str_cat.h"
#include "compensation/exact.h"
#include "compensation/singularity.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/compensation/pose_samples.h"

namespace truepose {
namespace {

using compensation::Arm;
using compensation::JointLimits;

constexpr int kPoses = 4000;
constexpr int kUniformPoses = 2000;  // of which the share that is not reached is told
constexpr double kShareOnRim = 0.5;
// Ranges found at drawn poses, half of them on the rim, fall short of the true ones: of 4,000 in
// six dimensions by some 1 % of the width at most.
constexpr double kWidening = 0.03;
constexpr int kCorrections = 2000;
constexpr double kMarginOverFound = 2;
constexpr double kLeastMargin = 1e-6;  // rad or m: of corrections that are nothing
constexpr double kLeastWidth = 1e-3;   // rad or m; of a box that is a plane or a line

std::vector<JointLimits> LimitsOr(const Arm& arm, double turn) {
  std::vector<JointLimits> limits(arm.limits.begin(), arm.limits.begin() + arm.nominal.joints);
  for (size_t i = 0; i < limits.size(); ++i) {
    if (arm.nominal.prismatic[i]) continue;
    if (!std::isfinite(limits[i].lower)) limits[i].lower = -turn;
    if (!std::isfinite(limits[i].upper)) limits[i].upper = turn;
  }
  return limits;
}

TableDomain OfRanges(const Arm& arm, const std::vector<JointLimits>& ranges) {
  TableDomain domain{TableAxes(arm, WeightOfControllerJoints(arm)), {}, {}};
  for (int k = 0; k < arm.nominal.joints; ++k) domain.range.push_back(domain.axes.Hull(k, ranges));
  return domain;
}

AxisRange Widened(AxisRange range, const AxisRange& widest) {
  const double more = kWidening * range.width() + kLeastWidth;
  return {std::max(range.lower - more, widest.lower), std::min(range.upper + more, widest.upper)};
}

AxisRange RangeOf(const TableAxes& axes, int k, const std::vector<JointVector>& q_chain) {
  AxisRange range{HUGE_VAL, -HUGE_VAL};
  for (const JointVector& q : q_chain) {
    const double u = axes.weight().row(k).dot(q);
    range = {std::min(range.lower, u), std::max(range.upper, u)};
  }
  return range;
}

absl::StatusOr<TableDomain> OfBox(const Arm& arm, const TableSpec& spec) {
  PoseSamples samples = SamplePoses(arm, *spec.box, kPoses, kShareOnRim, spec.seed);
  if (samples.q_chain.empty()) {
    FaultList faults;
    faults.Add(
        "box", absl::StrCat("none of ", kPoses, " poses drawn from it is reached"),
        "places that the arm reaches from its reference joints without passing a singularity");
    return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
  }
  const PoseSamples uniform = SamplePoses(arm, *spec.box, kUniformPoses, 0, spec.seed + 1);
  samples.q_chain.insert(samples.q_chain.end(), uniform.q_chain.begin(), uniform.q_chain.end());
  TableDomain domain{TableAxes(arm, WeightOfSamples(arm, samples.q_chain)), {}, {}};
  domain.poses = kUniformPoses;
  domain.unreachable = uniform.unreachable;
  for (int k = 0; k < arm.nominal.joints; ++k)
    domain.range.push_back(Widened(RangeOf(domain.axes, k, samples.q_chain),
                                   domain.axes.Hull(k, LimitsOr(arm, HUGE_VAL))));
  return domain;
}

// Exactly corrected coordinates, farther than allowed from a singularity.
std::optional<JointVector> CorrectedU(const Arm& arm, const TableAxes& axes, const JointVector& u,
                                      double smallest_singular_value) {
  const JointVector q = axes.ToController(u);
  const double length_m = compensation::CharacteristicLength(arm.nominal);
  if (compensation::SmallestSingularValue(arm, q.data(), length_m) < smallest_singular_value)
    return std::nullopt;
  const compensation::Correction corrected = compensation::CorrectJoints(arm, q.data(), {});
  if (corrected.outcome != compensation::Outcome::kOk) return std::nullopt;
  return axes.FromController(Eigen::Map<const Eigen::VectorXd>(corrected.q.data(), u.size()));
}

}  // namespace

absl::StatusOr<TableDomain> DomainOf(const Arm& arm, const TableSpec& spec) {
  TRUEPOSE_RETURN_IF_ERROR(Validate(spec, arm));
  if (spec.box) return OfBox(arm, spec);
  return OfRanges(arm, spec.ranges.empty() ? LimitsOr(arm, std::numbers::pi) : spec.ranges);
}

AxisRange WidestRange(const Arm& arm, const TableAxes& axes, int k) {
  return axes.Hull(k, LimitsOr(arm, 2 * std::numbers::pi));
}

std::vector<double> MarginsOf(const Arm& arm, const TableDomain& domain, const TableSpec& spec) {
  const auto n = static_cast<size_t>(domain.axes.joints());
  if (arm.measuring) return std::vector<double>(n, 0);
  JointVector largest = JointVector::Zero(domain.axes.joints());
  Random random(spec.seed);
  for (int i = 0; i < kCorrections; ++i) {
    const JointVector u = DrawIn(domain, &random);
    const auto corrected = CorrectedU(arm, domain.axes, u, spec.smallest_singular_value);
    if (corrected) largest = largest.cwiseMax((*corrected - u).cwiseAbs());
  }
  largest = (kMarginOverFound * largest).array() + kLeastMargin;
  return {largest.begin(), largest.end()};
}

JointVector DrawIn(const TableDomain& domain, Random* random) {
  JointVector u(domain.axes.joints());
  for (int k = 0; k < domain.axes.joints(); ++k)
    u(k) = random->Uniform(domain.range[static_cast<size_t>(k)].lower,
                           domain.range[static_cast<size_t>(k)].upper);
  return u;
}

}  // namespace truepose
