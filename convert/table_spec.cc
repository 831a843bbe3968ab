#include "convert/table_spec.h"

#include <cmath>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "convert/digest.h"
#include "convert/frames.h"
#include "core/base/fault.h"

namespace truepose::convert {
namespace {

// Nodes are floats: of corrections of some mm a float holds 1e-9 m, and a table of it meets no
// less than this.
constexpr double kLeastTolerance = 1e-8;

void CheckTolerance(double value, const char* unit, const std::string& field, FaultList* faults) {
  if (value == 0.0 || (std::isfinite(value) && value >= kLeastTolerance)) return;
  faults->Add(field, absl::StrCat(value), absl::StrCat(kLeastTolerance, " ", unit, " or more"));
}

void CheckRange(double lower, double upper, const std::string& lower_field,
                const std::string& upper_field, FaultList* faults) {
  CheckSize(lower, kLargestJoint, lower_field, faults);
  CheckSize(upper, kLargestJoint, upper_field, faults);
  if (!(lower < upper))
    faults->Add(upper_field, absl::StrCat(upper), absl::StrCat("more than ", lower));
}

std::string RangeField(int joint, const char* side) {
  return absl::StrCat("joint_ranges.joints[", joint, "].", side);
}

void CheckRanges(const v1::JointRangeDomain& domain, FaultList* faults) {
  if (domain.joints().empty()) faults->Add("joint_ranges.joints", "none", "one a joint");
  for (int i = 0; i < domain.joints_size(); ++i) {
    CheckRange(domain.joints(i).lower(), domain.joints(i).upper(), RangeField(i, "lower"),
               RangeField(i, "upper"), faults);
  }
}

void CheckApproach(const v1::BoxDomain& box, FaultList* faults) {
  const double length = std::hypot(box.approach_x(), box.approach_y(), box.approach_z());
  if (length == 0.0 || std::abs(length - 1.0) <= kUnitTolerance) return;
  faults->Add("box.approach_x", absl::StrCat("a vector of length ", length), "a unit vector");
}

void CheckRoll(const v1::BoxDomain& box, FaultList* faults) {
  if (box.min_roll_rad() == 0.0 && box.max_roll_rad() == 0.0) return;
  CheckRange(box.min_roll_rad(), box.max_roll_rad(), "box.min_roll_rad", "box.max_roll_rad",
             faults);
}

void CheckBox(const v1::BoxDomain& box, FaultList* faults) {
  CheckRange(box.min_x_m(), box.max_x_m(), "box.min_x_m", "box.max_x_m", faults);
  CheckRange(box.min_y_m(), box.max_y_m(), "box.min_y_m", "box.max_y_m", faults);
  CheckRange(box.min_z_m(), box.max_z_m(), "box.min_z_m", "box.max_z_m", faults);
  CheckApproach(box, faults);
  if (!(box.cone_rad() >= 0.0 && box.cone_rad() <= std::numbers::pi))
    faults->Add("box.cone_rad", absl::StrCat(box.cone_rad()), "0 to pi");
  CheckRoll(box, faults);
  if (box.reference_joints().empty())
    faults->Add("box.reference_joints", "none", "one a joint, which pick the configuration");
  for (int i = 0; i < box.reference_joints_size(); ++i) {
    CheckSize(box.reference_joints(i), kLargestJoint, absl::StrCat("box.reference_joints[", i, "]"),
              faults);
  }
}

void CheckFigures(const v1::CompensationTableSpec& spec, FaultList* faults) {
  CheckTolerance(spec.position_tolerance_m(), "m", "position_tolerance_m", faults);
  CheckTolerance(spec.rotation_tolerance_rad(), "rad", "rotation_tolerance_rad", faults);
  if (!(spec.smallest_singular_value() >= 0.0 && spec.smallest_singular_value() < 1.0))
    faults->Add("smallest_singular_value", absl::StrCat(spec.smallest_singular_value()),
                "0 to 1; 0 = the default");
  const int points = spec.verification_points();
  if (points != 0 && (points < kFewestVerificationPoints || points > kMostVerificationPoints))
    faults->Add("verification_points", absl::StrCat(points),
                absl::StrCat(kFewestVerificationPoints, " to ", kMostVerificationPoints));
  if (spec.largest_bytes() < 0 || spec.largest_bytes() > kTableLargestBytes)
    faults->Add("largest_bytes", absl::StrCat(spec.largest_bytes()),
                absl::StrCat("at most ", kTableLargestBytes));
}

FaultList FaultsOfSpec(const v1::CompensationTableSpec& spec) {
  FaultList faults;
  if (spec.has_joint_ranges()) CheckRanges(spec.joint_ranges(), &faults);
  if (spec.has_box()) CheckBox(spec.box(), &faults);
  CheckFigures(spec, &faults);
  return faults;
}

void CheckCount(int found, int joints, const char* field, FaultList* faults) {
  if (found == joints || found == 0) return;
  faults->Add(field, absl::StrCat(found, " values"), absl::StrCat(joints, ", one a joint"));
}

void CheckLimits(const v1::Nominal& nominal, const v1::JointRangeDomain& domain,
                 FaultList* faults) {
  CheckCount(domain.joints_size(), nominal.joints_size(), "joint_ranges.joints", faults);
  for (int i = 0; i < domain.joints_size() && i < nominal.joints_size(); ++i) {
    const v1::Joint& joint = nominal.joints(i);
    const v1::JointRange& range = domain.joints(i);
    if (joint.has_lower() && range.lower() < joint.lower())
      faults->Add(RangeField(i, "lower"), absl::StrCat(range.lower()),
                  absl::StrCat("at least ", joint.lower(), ", the joint's limit"));
    if (joint.has_upper() && range.upper() > joint.upper())
      faults->Add(RangeField(i, "upper"), absl::StrCat(range.upper()),
                  absl::StrCat("at most ", joint.upper(), ", the joint's limit"));
  }
}

void CheckTool(const v1::Nominal& nominal, const std::string& tool, FaultList* faults) {
  std::string known;
  for (const v1::Tool& one : nominal.tools()) {
    if (one.name() == tool) return;
    absl::StrAppend(&known, known.empty() ? "" : ", ", one.name());
  }
  if (!tool.empty()) faults->Add("box.tool", tool, known.empty() ? "no tool" : known);
}

template <typename T>
T Or(T given, T standard) {
  return given == T{} ? standard : given;
}

std::string BoxText(const v1::BoxDomain& box) {
  std::string text =
      absl::StrFormat("box %a %a %a %a %a %a\ntool %s\napproach %a %a %a\ncone %a\nroll %a %a\n",
                      box.min_x_m(), box.min_y_m(), box.min_z_m(), box.max_x_m(), box.max_y_m(),
                      box.max_z_m(), box.tool(), box.approach_x(), box.approach_y(),
                      box.approach_z(), box.cone_rad(), box.min_roll_rad(), box.max_roll_rad());
  for (const double joint : box.reference_joints())
    absl::StrAppend(&text, absl::StrFormat("reference %a\n", joint));
  return text;
}

std::string DomainText(const v1::CompensationTableSpec& spec) {
  if (spec.has_box()) return BoxText(spec.box());
  std::string text = "joints\n";
  for (const v1::JointRange& range : spec.joint_ranges().joints())
    absl::StrAppend(&text, absl::StrFormat("range %a %a\n", range.lower(), range.upper()));
  return text;
}

}  // namespace

absl::Status ValidateTableSpec(const v1::CompensationTableSpec& spec) {
  return FaultsOfSpec(spec).ToStatus();
}

absl::Status ValidateTableSpec(const v1::Nominal& nominal, const v1::CompensationTableSpec& spec) {
  FaultList faults = FaultsOfSpec(spec);
  if (spec.has_joint_ranges()) CheckLimits(nominal, spec.joint_ranges(), &faults);
  CheckCount(spec.box().reference_joints_size(), nominal.joints_size(), "box.reference_joints",
             &faults);
  CheckTool(nominal, spec.box().tool(), &faults);
  return faults.ToStatus();
}

v1::CompensationTableSpec CompleteTableSpec(const v1::CompensationTableSpec& spec) {
  v1::CompensationTableSpec complete = spec;
  complete.set_position_tolerance_m(Or(spec.position_tolerance_m(), kTablePositionTolerance_m));
  complete.set_rotation_tolerance_rad(
      Or(spec.rotation_tolerance_rad(), kTableRotationTolerance_rad));
  complete.set_smallest_singular_value(
      Or(spec.smallest_singular_value(), kTableSmallestSingularValue));
  complete.set_verification_points(Or(spec.verification_points(), kTableVerificationPoints));
  complete.set_largest_bytes(Or<int64_t>(spec.largest_bytes(), kTableLargestBytes));
  const v1::BoxDomain& box = spec.box();
  const bool unset = box.approach_x() == 0.0 && box.approach_y() == 0.0 && box.approach_z() == 0.0;
  if (spec.has_box() && unset) complete.mutable_box()->set_approach_z(-1.0);
  return complete;
}

std::string TableInputDigest(const std::string& calibration_digest,
                             const std::string& nominal_digest,
                             const v1::CompensationTableSpec& spec) {
  const v1::CompensationTableSpec complete = CompleteTableSpec(spec);
  return Sha256(absl::StrCat(
      "calibration ", calibration_digest, "\nnominal ", nominal_digest, "\n", DomainText(complete),
      absl::StrFormat("position_tolerance_m %a\nrotation_tolerance_rad %a\n",
                      complete.position_tolerance_m(), complete.rotation_tolerance_rad()),
      absl::StrFormat("smallest_singular_value %a\n", complete.smallest_singular_value()),
      "verification_points ", complete.verification_points(), "\nlargest_bytes ",
      complete.largest_bytes(), "\nseed ", complete.seed(), "\n"));
}

}  // namespace truepose::convert
