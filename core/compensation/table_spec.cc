#include "core/compensation/table_spec.h"

#include <cmath>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"

namespace truepose {
namespace {

using compensation::Arm;
using compensation::JointLimits;

constexpr double kLeastTolerance = 1e-9;  // nodes are single precision: 1e-7 of a correction of mm
constexpr int kFewestPoints = 1000;
constexpr int64_t kLargestBytes = int64_t{64} << 20;
constexpr double kRounding = 1e-9;  // a range that was typed in deg or mm may end beyond the limit

// As a spec has joints: rad, or m of those that slide.
const char* UnitOf(const Arm& arm, int joint) {
  return arm.nominal.prismatic[joint] ? " m" : " rad";
}

std::string Text(const JointLimits& range, const char* unit) {
  return absl::StrCat(range.lower, " to ", range.upper, unit);
}

void CheckRange(const JointLimits& range, const Arm& arm, int joint, const std::string& field,
                FaultList* faults) {
  const JointLimits& limits = arm.limits[joint];
  const char* const unit = UnitOf(arm, joint);
  if (!(std::isfinite(range.lower) && std::isfinite(range.upper) && range.lower < range.upper))
    return faults->Add(field, Text(range, unit), "two values, the smaller first");
  if (range.lower < limits.lower - kRounding || range.upper > limits.upper + kRounding)
    faults->Add(field, Text(range, unit),
                absl::StrCat("within the joint's limits ", Text(limits, unit)));
}

void CheckRanges(const TableSpec& spec, const Arm& arm, FaultList* faults) {
  if (static_cast<int>(spec.ranges.size()) != arm.nominal.joints)
    return faults->Add("joint_ranges.joints", absl::StrCat(spec.ranges.size(), " ranges"),
                       absl::StrCat(arm.nominal.joints, ", one a joint"));
  for (int i = 0; i < arm.nominal.joints; ++i)
    CheckRange(spec.ranges[i], arm, i, absl::StrCat("joint_ranges.joints[", i, "]"), faults);
}

// Revolute joints without limits get a turn; there is no such length for a prismatic one.
void CheckLimits(const Arm& arm, FaultList* faults) {
  for (int i = 0; i < arm.nominal.joints; ++i) {
    if (!arm.nominal.prismatic[i]) continue;
    if (std::isfinite(arm.limits[i].lower) && std::isfinite(arm.limits[i].upper)) continue;
    faults->Add(absl::StrCat("joint_ranges.joints[", i, "]"), "a prismatic joint without limits",
                "a range for it");
  }
}

void CheckReference(const BoxDomain& box, const Arm& arm, FaultList* faults) {
  if (box.reference.size() != arm.nominal.joints)
    return faults->Add("box.reference_joints", absl::StrCat(box.reference.size(), " values"),
                       absl::StrCat(arm.nominal.joints, ", one a joint"));
  for (int i = 0; i < arm.nominal.joints; ++i) {
    const double q = box.reference(i);
    if (std::isfinite(q) && q >= arm.limits[i].lower && q <= arm.limits[i].upper) continue;
    const char* const unit = UnitOf(arm, i);
    faults->Add(absl::StrCat("box.reference_joints[", i, "]"), absl::StrCat(q, unit),
                absl::StrCat("within the joint's limits ", Text(arm.limits[i], unit)));
  }
}

void CheckBox(const BoxDomain& box, const Arm& arm, FaultList* faults) {
  const bool finite = box.box_B.min().allFinite() && box.box_B.max().allFinite();
  if (!finite || box.box_B.isEmpty())
    faults->Add("box", "no volume", "three ranges, the smaller value first");
  if (!box.approach_B.allFinite() || box.approach_B.norm() < 1e-6)
    faults->Add("box.approach", "no direction", "a vector");
  if (!(box.cone_rad >= 0 && box.cone_rad <= std::numbers::pi))
    faults->Add("box.cone_rad", absl::StrCat(box.cone_rad, " rad"),
                absl::StrCat("0 rad to ", std::numbers::pi, " rad"));
  if (!(std::abs(box.roll_lower_rad) <= 2 * std::numbers::pi &&
        std::abs(box.roll_upper_rad) <= 2 * std::numbers::pi &&
        box.roll_lower_rad <= box.roll_upper_rad))
    faults->Add("box.min_roll_rad",
                absl::StrCat(box.roll_lower_rad, " rad to ", box.roll_upper_rad, " rad"),
                "two angles within a turn, the smaller first");
  CheckReference(box, arm, faults);
}

void CheckTolerance(double value, double least, const std::string& field, FaultList* faults) {
  if (!(value >= least && value <= 1))
    faults->Add(field, absl::StrCat(value), absl::StrCat(least, " to 1"));
}

}  // namespace

absl::Status Validate(const TableSpec& spec, const Arm& arm) {
  FaultList faults;
  if (spec.box)
    CheckBox(*spec.box, arm, &faults);
  else if (!spec.ranges.empty())
    CheckRanges(spec, arm, &faults);
  else
    CheckLimits(arm, &faults);
  CheckTolerance(spec.position_tolerance_m, kLeastTolerance, "position_tolerance_m", &faults);
  CheckTolerance(spec.rotation_tolerance_rad, kLeastTolerance, "rotation_tolerance_rad", &faults);
  CheckTolerance(spec.smallest_singular_value, kLeastSingularValue, "smallest_singular_value",
                 &faults);
  if (spec.verification_points < kFewestPoints)
    faults.Add("verification_points", absl::StrCat(spec.verification_points),
               absl::StrCat("at least ", kFewestPoints));
  if (spec.largest_bytes < 1 || spec.largest_bytes > kLargestBytes)
    faults.Add("largest_bytes", absl::StrCat(spec.largest_bytes),
               absl::StrCat("1 to ", kLargestBytes));
  return faults.ToStatus();
}

}  // namespace truepose
