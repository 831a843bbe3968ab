// What can be wrong with readings and options, and which joints exceed their limits.
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "convert/frames.h"
#include "convert/run.h"
#include "core/assessment/split.h"
#include "core/base/fault.h"

namespace truepose::convert {
namespace {

void CheckJoints(const google::protobuf::RepeatedField<double>& values, int joints,
                 const std::string& field, FaultList* faults) {
  if (values.size() != 0 && values.size() != joints) {
    faults->Add(field, absl::StrCat(values.size(), " values"),
                absl::StrCat(joints, ", one for each joint"));
  }
  for (int i = 0; i < values.size(); ++i)
    CheckSize(values[i], kLargestJoint, absl::StrCat(field, "[", i, "]"), faults);
}

void CheckAxis(const v1::Vector3& axis, const std::string& field, FaultList* faults) {
  CheckVector(axis, field, faults);
  const double length = VectorFrom(axis).norm();
  if (std::isfinite(length) && std::abs(length - 1) > kUnitTolerance) {
    faults->Add(field, absl::StrCat("a vector of length ", length), "a unit vector");
  }
}

void CheckDeviations(const v1::Vector3& sd, const std::string& field, FaultList* faults) {
  CheckVector(sd, field, faults);
  if (VectorFrom(sd).minCoeff() < 0)
    faults->Add(field, "a negative standard deviation", "0 or more");
}

void CheckReading(const v1::Reading& reading, int joints, int row, const std::string& field,
                  FaultList* faults) {
  if (reading.row() != row)
    faults->Add(field + ".row", absl::StrCat(reading.row()),
                absl::StrCat(row, ", rows without gaps"));
  CheckJoints(reading.joints_measured(), joints, field + ".joints_measured", faults);
  CheckJoints(reading.joints_commanded(), joints, field + ".joints_commanded", faults);
  CheckJoints(reading.joint_torques_nm(), joints, field + ".joint_torques_nm", faults);
  if (reading.has_position_m()) CheckVector(reading.position_m(), field + ".position_m", faults);
  if (reading.has_orientation())
    CheckQuaternion(reading.orientation(), field + ".orientation", faults);
  if (reading.has_axis()) CheckAxis(reading.axis(), field + ".axis", faults);
  if (reading.has_position_sd_m())
    CheckDeviations(reading.position_sd_m(), field + ".position_sd_m", faults);
  if (reading.has_temperature_c())
    CheckFinite(reading.temperature_c(), field + ".temperature_c", faults);
}

// Rows in a warning: enough to find them, not so many that they hide the rest.
constexpr size_t kRowsShown = 20;

std::string Rows(const std::vector<int>& rows) {
  const size_t shown = std::min(rows.size(), kRowsShown);
  return absl::StrCat(
      rows.size() == 1 ? "row " : "rows ",
      absl::StrJoin(rows.begin(), rows.begin() + static_cast<long>(shown), ", "),
      rows.size() > shown ? absl::StrCat(" and ", rows.size() - shown, " more") : "");
}

std::string InUnits(double value, v1::JointType type) {
  return type == v1::PRISMATIC ? absl::StrFormat("%.6g mm", value * 1e3)
                               : absl::StrFormat("%.6g deg", value * 180 / 3.14159265358979323846);
}

// The rows in which a joint is beyond a limit, by `exceeds`, of measured joints or, where there are
// none, commanded ones.
template <typename Exceeds>
std::vector<int> RowsBeyond(const std::vector<v1::Reading>& readings, int joint, Exceeds exceeds) {
  std::vector<int> rows;
  for (const v1::Reading& reading : readings) {
    const auto& q =
        reading.joints_measured_size() > 0 ? reading.joints_measured() : reading.joints_commanded();
    if (joint < q.size() && exceeds(q[joint])) rows.push_back(reading.row());
  }
  return rows;
}

void CheckName(const std::string& value, const std::string& only, const std::string& field,
               FaultList* faults) {
  if (!value.empty() && value != only) faults->Add(field, absl::StrCat("'", value, "'"), only);
}

}  // namespace

absl::Status ValidateReadings(const v1::Nominal& nominal, const std::vector<v1::Reading>& readings,
                              int first_row) {
  FaultList faults;
  for (size_t i = 0; i < readings.size(); ++i) {
    CheckReading(readings[i], nominal.joints_size(), first_row + static_cast<int>(i),
                 absl::StrCat("readings[", i, "]"), &faults);
  }
  return faults.ToStatus();
}

std::vector<std::string> LimitWarnings(const v1::Nominal& nominal,
                                       const std::vector<v1::Reading>& readings) {
  std::vector<std::string> warnings;
  for (int i = 0; i < nominal.joints_size(); ++i) {
    const v1::Joint& joint = nominal.joints(i);
    const auto warn = [&](const char* side, double limit, const std::vector<int>& rows) {
      if (rows.empty()) return;
      warnings.push_back(absl::StrCat("joint ", joint.name(), " is ", side, " its limit of ",
                                      InUnits(limit, joint.type()), " in ", Rows(rows)));
    };
    if (joint.has_lower()) {
      warn("below", joint.lower(),
           RowsBeyond(readings, i, [&](double q) { return q < joint.lower(); }));
    }
    if (joint.has_upper()) {
      warn("above", joint.upper(),
           RowsBeyond(readings, i, [&](double q) { return q > joint.upper(); }));
    }
  }
  return warnings;
}

absl::Status ValidateOptions(const v1::CalibrationOptions& options) {
  FaultList faults;
  faults.AddAll(ParseSplit(options.split()).status());
  CheckName(options.model(), "modified_incremental", "options.model", &faults);
  CheckName(options.estimator(), "levenberg_marquardt", "options.estimator", &faults);
  if (options.observe() < v1::OBSERVE_UNSPECIFIED || options.observe() > v1::POINT_AXIS) {
    faults.Add("options.observe", absl::StrCat(static_cast<int>(options.observe())),
               "POSE, POINT or POINT_AXIS");
  }
  return faults.ToStatus();
}

}  // namespace truepose::convert
