#include "client/agent/intake/reading_check.h"

#include <cmath>
#include <set>

#include "absl/strings/str_cat.h"
#include "client/agent/intake/utf8.h"

namespace truepose::agent {
namespace {

constexpr double kLargestJoint = 1e6;  // rad or m
constexpr double kLargestLength_m = 1e4;
constexpr double kUnitTolerance = 1e-6;
constexpr double kAbsoluteZero_C = -273.15;

void CheckSize(double value, double largest, const std::string& field, FaultList* faults) {
  if (std::abs(value) <= largest) return;
  faults->Add(field, absl::StrCat(value), absl::StrCat("a finite number of at most ", largest));
}

void CheckVector(const v1::Vector3& v, const std::string& field, FaultList* faults) {
  CheckSize(v.x(), kLargestLength_m, field + ".x", faults);
  CheckSize(v.y(), kLargestLength_m, field + ".y", faults);
  CheckSize(v.z(), kLargestLength_m, field + ".z", faults);
}

// NaN is no unit either.
void CheckUnit(double length, const std::string& field, FaultList* faults) {
  // A little narrower than the server's: its sum may be rounded otherwise.
  if (std::abs(length - 1) <= kUnitTolerance * (1 - 1e-6)) return;
  faults->Add(field, absl::StrCat("length ", length), "length 1");
}

void CheckDeviations(const v1::Vector3& sd, const std::string& field, FaultList* faults) {
  CheckVector(sd, field, faults);
  if (sd.x() < 0 || sd.y() < 0 || sd.z() < 0)
    faults->Add(field, "a negative standard deviation", "0 or more");
}

void CheckJoints(const google::protobuf::RepeatedField<double>& values, int joints,
                 const std::string& field, FaultList* faults) {
  if (values.size() != 0 && values.size() != joints)
    faults->Add(field, absl::StrCat(values.size(), " values"),
                absl::StrCat(joints, ", one for each joint"));
  for (int i = 0; i < values.size(); ++i)
    CheckSize(values[i], kLargestJoint, absl::StrCat(field, "[", i, "]"), faults);
}

void CheckOrientation(const v1::Reading& reading, const std::string& field, FaultList* faults) {
  const v1::Quaternion& q = reading.orientation();
  if (reading.has_orientation())
    CheckUnit(std::sqrt(q.x() * q.x() + q.y() * q.y() + q.z() * q.z() + q.w() * q.w()),
              field + ".orientation", faults);
  const v1::Vector3& a = reading.axis();
  if (!reading.has_axis()) return;
  CheckVector(a, field + ".axis", faults);
  CheckUnit(std::sqrt(a.x() * a.x() + a.y() * a.y() + a.z() * a.z()), field + ".axis", faults);
}

void CheckCoordinates(const v1::Reading& reading, const std::string& field, FaultList* faults) {
  const std::string& text = reading.coordinates();
  if (text.empty()) return;
  static const auto& known = *new std::set<std::string>{"x", "y", "z", "xy", "xz", "yz"};
  if (known.count(text) == 0)
    faults->Add(field, absl::StrCat("'", text, "'"), "x, y, z, xy, xz, yz or none for all three");
  if (!reading.has_position_m()) faults->Add(field, "no position", "the coordinates' values");
  if (reading.has_orientation() || reading.has_axis())
    faults->Add(field, absl::StrCat("only '", text, "' beside an orientation"),
                "all three coordinates of a pose");
}

void CheckPoints(const v1::Reading& reading, const std::string& field, FaultList* faults) {
  std::set<std::string> targets;
  for (int i = 0; i < reading.points_size(); ++i) {
    const v1::MeasuredPoint& point = reading.points(i);
    const std::string path = absl::StrCat(field, "[", i, "]");
    if (point.target().empty()) faults->Add(path + ".target", "an empty name", "a name");
    if (!point.has_position_m()) faults->Add(path + ".position_m", "none", "a position");
    CheckVector(point.position_m(), path + ".position_m", faults);
    if (point.has_position_sd_m())
      CheckDeviations(point.position_sd_m(), path + ".position_sd_m", faults);
    if (!targets.insert(point.target()).second)
      faults->Add(path + ".target", absl::StrCat("'", point.target(), "' again"),
                  "each point of a reading once");
  }
}

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
  if (std::isfinite(reading.temperature_c()) && reading.temperature_c() >= kAbsoluteZero_C) return;
  faults->Add(field, absl::StrCat(reading.temperature_c()),
              absl::StrCat("at least ", kAbsoluteZero_C));
}

}  // namespace

void CheckReading(const v1::Reading& reading, int joints, const std::string& field,
                  FaultList* faults) {
  CheckJoints(reading.joints_measured(), joints, field + ".joints_measured", faults);
  CheckJoints(reading.joints_commanded(), joints, field + ".joints_commanded", faults);
  CheckJoints(reading.joint_torques_nm(), joints, field + ".joint_torques_nm", faults);
  if (reading.joints_measured().empty() && reading.joints_commanded().empty())
    faults->Add(field, "no joints", absl::StrCat(joints, " joints, measured or commanded"));
  if (reading.has_position_m()) CheckVector(reading.position_m(), field + ".position_m", faults);
  if (reading.has_position_sd_m())
    CheckDeviations(reading.position_sd_m(), field + ".position_sd_m", faults);
  CheckOrientation(reading, field, faults);
  CheckCoordinates(reading, field + ".coordinates", faults);
  CheckPoints(reading, field + ".points", faults);
  CheckDistance(reading, field, faults);
  CheckTemperature(reading, field + ".temperature_c", faults);
  CheckText(reading, field, faults);
  if (static_cast<int64_t>(reading.ByteSizeLong()) > kLargestReading)
    faults->Add(field, absl::StrCat(reading.ByteSizeLong(), " bytes"),
                absl::StrCat("at most ", kLargestReading));
}

}  // namespace truepose::agent
