#include "convert/table_spec.h"

#include <array>
#include <cmath>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "convert/digest.h"
#include "convert/frames.h"
#include "core/base/fault.h"
#include "core/compensation/table_spec.h"

namespace truepose::convert {
namespace {

// Nodes are floats: of corrections of some mm a float holds 1e-9 m, and a table of it meets no
// less than this. More than the most is no correction at all.
constexpr double kLeastTolerance = 1e-8, kMostTolerance = 1;
constexpr double kTurn = 2 * std::numbers::pi;

void CheckTolerance(double value, const std::string& field, FaultList* faults) {
  if (value >= kLeastTolerance && value <= kMostTolerance) return;
  const char* const unit = UnitOf(field);
  faults->Add(field, absl::StrCat(value, unit),
              absl::StrCat(kLeastTolerance, unit, " to ", kMostTolerance, unit, ", or none"));
}

void CheckRange(double lower, double upper, const std::string& lower_field,
                const std::string& upper_field, FaultList* faults) {
  CheckSize(lower, kLargestJoint, lower_field, faults);
  CheckSize(upper, kLargestJoint, upper_field, faults);
  const char* const unit = UnitOf(upper_field);
  if (!(lower < upper))
    faults->Add(upper_field, absl::StrCat(upper, unit), absl::StrCat("more than ", lower, unit));
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
  CheckSize(box.min_roll_rad(), kTurn, "box.min_roll_rad", faults);
  CheckSize(box.max_roll_rad(), kTurn, "box.max_roll_rad", faults);
}

// Along one axis of B.
struct Edges {
  const char* axis;
  bool has_lower, has_upper;
  double lower, upper;
};

std::array<Edges, 3> EdgesOf(const v1::BoxDomain& box) {
  return {{{"x", box.has_min_x_m(), box.has_max_x_m(), box.min_x_m(), box.max_x_m()},
           {"y", box.has_min_y_m(), box.has_max_y_m(), box.min_y_m(), box.max_y_m()},
           {"z", box.has_min_z_m(), box.has_max_z_m(), box.min_z_m(), box.max_z_m()}}};
}

void CheckEdges(const Edges& edges, FaultList* faults) {
  const std::string lower = absl::StrCat("box.min_", edges.axis, "_m");
  const std::string upper = absl::StrCat("box.max_", edges.axis, "_m");
  if (!edges.has_lower) faults->Add(lower, "nothing", "all six edges of the box");
  if (!edges.has_upper) faults->Add(upper, "nothing", "all six edges of the box");
  if (edges.has_lower && edges.has_upper)
    CheckRange(edges.lower, edges.upper, lower, upper, faults);
}

void CheckBox(const v1::BoxDomain& box, FaultList* faults) {
  for (const Edges& edges : EdgesOf(box)) CheckEdges(edges, faults);
  CheckApproach(box, faults);
  if (!(box.cone_rad() >= 0.0 && box.cone_rad() <= std::numbers::pi))
    faults->Add("box.cone_rad", absl::StrCat(box.cone_rad(), " rad"),
                absl::StrCat("0 rad to ", std::numbers::pi, " rad"));
  CheckRoll(box, faults);
  if (box.reference_joints().empty())
    faults->Add("box.reference_joints", "none", "one a joint, which pick the configuration");
  for (int i = 0; i < box.reference_joints_size(); ++i) {
    CheckSize(box.reference_joints(i), kLargestJoint, absl::StrCat("box.reference_joints[", i, "]"),
              faults);
  }
}

void CheckFigures(const v1::CompensationTableSpec& spec, FaultList* faults) {
  if (spec.has_position_tolerance_m())
    CheckTolerance(spec.position_tolerance_m(), "position_tolerance_m", faults);
  if (spec.has_rotation_tolerance_rad())
    CheckTolerance(spec.rotation_tolerance_rad(), "rotation_tolerance_rad", faults);
  const double singular = spec.smallest_singular_value();
  if (singular != 0.0 && !(singular >= kLeastSingularValue && singular < 1.0))
    faults->Add("smallest_singular_value", absl::StrCat(singular),
                absl::StrCat(kLeastSingularValue, " to 1, or 0 = the default"));
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
    const char* const unit = joint.type() == v1::PRISMATIC ? " m" : " rad";
    if (joint.has_lower() && range.lower() < joint.lower())
      faults->Add(RangeField(i, "lower"), absl::StrCat(range.lower(), unit),
                  absl::StrCat("at least ", joint.lower(), unit, ", the joint's limit"));
    if (joint.has_upper() && range.upper() > joint.upper())
      faults->Add(RangeField(i, "upper"), absl::StrCat(range.upper(), unit),
                  absl::StrCat("at most ", joint.upper(), unit, ", the joint's limit"));
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

// A spec of the store may be older than edges that can be missing: 0 was then written as nothing.
void GiveEdges(v1::BoxDomain* box) {
  box->set_min_x_m(box->min_x_m());
  box->set_min_y_m(box->min_y_m());
  box->set_min_z_m(box->min_z_m());
  box->set_max_x_m(box->max_x_m());
  box->set_max_y_m(box->max_y_m());
  box->set_max_z_m(box->max_z_m());
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

v1::CompensationTableSpec StoredTableSpec(v1::CompensationTableSpec spec) {
  if (spec.has_box()) GiveEdges(spec.mutable_box());
  return spec;
}

v1::CompensationTableSpec CompleteTableSpec(const v1::CompensationTableSpec& spec) {
  v1::CompensationTableSpec complete = StoredTableSpec(spec);
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
