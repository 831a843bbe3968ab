#include "convert/rules/reading_rules.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "absl/strings/str_cat.h"
#include "convert/rules/values.h"

namespace truepose::convert {
namespace {

constexpr double kAbsoluteZero_C = -273.15;

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
  const double length = std::sqrt(axis.x() * axis.x() + axis.y() * axis.y() + axis.z() * axis.z());
  if (std::isfinite(length) && std::abs(length - 1) > kUnitTolerance) {
    faults->Add(field, absl::StrCat("a vector of length ", length), "a unit vector");
  }
}

void CheckDeviations(const v1::Vector3& sd, const std::string& field, FaultList* faults) {
  CheckVector(sd, field, faults);
  if (sd.x() < 0 || sd.y() < 0 || sd.z() < 0)
    faults->Add(field, "a negative standard deviation", "0 or more");
}

// Of a pose with a coordinate missing nothing is taken, so it may not be there.
void CheckCoordinates(const v1::Reading& reading, const std::string& field, FaultList* faults) {
  const std::string& text = reading.coordinates();
  if (text.empty()) return;
  static const std::set<std::string> known = {"x", "y", "z", "xy", "xz", "yz"};
  if (known.count(text) == 0)
    faults->Add(field, absl::StrCat("'", text, "'"), "x, y, z, xy, xz, yz or none for all three");
  if (!reading.has_position_m()) faults->Add(field, "no position_m", "the coordinates' values");
  if (reading.has_orientation() || reading.has_axis()) {
    faults->Add(field, absl::StrCat("only '", text, "' beside an orientation"),
                "all three coordinates of a pose");
  }
}

void CheckPoint(const v1::MeasuredPoint& point, const std::string& field, FaultList* faults) {
  if (point.target().empty()) faults->Add(field + ".target", "an empty name", "a name");
  if (!point.has_position_m()) faults->Add(field + ".position_m", "none", "a position");
  CheckVector(point.position_m(), field + ".position_m", faults);
  if (point.has_position_sd_m())
    CheckDeviations(point.position_sd_m(), field + ".position_sd_m", faults);
}

void CheckPoints(const v1::Reading& reading, const std::string& field, FaultList* faults) {
  std::set<std::string> targets;
  for (int i = 0; i < reading.points_size(); ++i) {
    const std::string path = absl::StrCat(field, "[", i, "]");
    CheckPoint(reading.points(i), path, faults);
    if (!targets.insert(reading.points(i).target()).second) {
      faults->Add(path + ".target", absl::StrCat("'", reading.points(i).target(), "' again"),
                  "each point of a reading once");
    }
  }
}

// A beam counts from anywhere, so its distances may be negative.
void CheckDistance(const v1::Reading& reading, const std::string& field, FaultList* faults) {
  if (!reading.has_distance_m()) return;
  CheckSize(reading.distance_m(), kLargestLength_m, field + ".distance_m", faults);
  if (reading.distance_m() < 0 && reading.beam().empty())
    faults->Add(field + ".distance_m", absl::StrCat(reading.distance_m()), "0 or more, or a beam");
  if (reading.anchor().empty())
    faults->Add(field + ".anchor", "no name", "the point that the distance is from");
  if (!reading.has_distance_sd_m()) return;
  CheckSize(reading.distance_sd_m(), kLargestLength_m, field + ".distance_sd_m", faults);
  if (reading.distance_sd_m() < 0)
    faults->Add(field + ".distance_sd_m", "a negative standard deviation", "0 or more");
}

void CheckTemperature(const v1::Reading& reading, const std::string& field, FaultList* faults) {
  if (!reading.has_temperature_c()) return;
  CheckFinite(reading.temperature_c(), field, faults);
  if (reading.temperature_c() < kAbsoluteZero_C) {
    faults->Add(field, absl::StrCat(reading.temperature_c()),
                absl::StrCat("at least ", kAbsoluteZero_C));
  }
}

void CheckPosition(const v1::Reading& reading, const std::string& field, FaultList* faults) {
  if (reading.has_position_m()) CheckVector(reading.position_m(), field + ".position_m", faults);
  if (reading.has_orientation())
    CheckQuaternion(reading.orientation(), field + ".orientation", faults);
  if (reading.has_axis()) CheckAxis(reading.axis(), field + ".axis", faults);
  if (reading.has_position_sd_m())
    CheckDeviations(reading.position_sd_m(), field + ".position_sd_m", faults);
  CheckCoordinates(reading, field + ".coordinates", faults);
}

bool AreWithin(const google::protobuf::RepeatedField<double>& values, int joints) {
  if (values.size() != 0 && values.size() != joints) return false;
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::abs(value) <= kLargestJoint; });
}

bool IsWithin(const v1::Vector3& v) {
  return std::abs(v.x()) <= kLargestLength_m && std::abs(v.y()) <= kLargestLength_m &&
         std::abs(v.z()) <= kLargestLength_m;
}

bool IsUnit(const v1::Quaternion& q) {
  const double length = std::sqrt(q.x() * q.x() + q.y() * q.y() + q.z() * q.z() + q.w() * q.w());
  // Half of what is allowed: the sum may be rounded otherwise there.
  return std::abs(length - 1) <= kUnitTolerance / 2;
}

bool IsPlain(const v1::Reading& reading) {
  return reading.points().empty() && reading.coordinates().empty() && !reading.has_axis() &&
         !reading.has_position_sd_m() && !reading.has_distance_m() && !reading.has_temperature_c();
}

}  // namespace

void CheckReading(const v1::Reading& reading, int joints, const std::string& field,
                  FaultList* faults) {
  CheckJoints(reading.joints_measured(), joints, field + ".joints_measured", faults);
  CheckJoints(reading.joints_commanded(), joints, field + ".joints_commanded", faults);
  CheckJoints(reading.joint_torques_nm(), joints, field + ".joint_torques_nm", faults);
  CheckPosition(reading, field, faults);
  CheckPoints(reading, field + ".points", faults);
  CheckDistance(reading, field, faults);
  CheckTemperature(reading, field + ".temperature_c", faults);
}

bool IsSound(const v1::Reading& reading, int joints) {
  return IsPlain(reading) && AreWithin(reading.joints_measured(), joints) &&
         AreWithin(reading.joints_commanded(), joints) &&
         AreWithin(reading.joint_torques_nm(), joints) && IsWithin(reading.position_m()) &&
         (!reading.has_orientation() || IsUnit(reading.orientation()));
}

}  // namespace truepose::convert
