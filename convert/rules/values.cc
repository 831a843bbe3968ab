#include "convert/rules/values.h"

#include <cmath>

#include "absl/strings/str_cat.h"

namespace truepose::convert {
namespace {

void CheckUnit(double x, double y, double z, double w, const std::string& field,
               FaultList* faults) {
  const double length = std::sqrt(x * x + y * y + z * z + w * w);
  if (!std::isfinite(length)) {
    faults->Add(field, "a value that is not finite", "finite numbers");
  } else if (std::abs(length - 1) > kUnitTolerance) {
    faults->Add(field, absl::StrCat("a quaternion of length ", length), "a unit quaternion");
  }
}

}  // namespace

void CheckFinite(double value, const std::string& field, FaultList* faults) {
  if (!std::isfinite(value)) faults->Add(field, absl::StrCat(value), "a finite number");
}

const char* UnitOf(const std::string& field) {
  if (field.ends_with("_m")) return " m";
  return field.ends_with("_rad") ? " rad" : "";
}

void CheckSize(double value, double largest, const std::string& field, FaultList* faults) {
  if (std::abs(value) <= largest) return;
  const char* const unit = UnitOf(field);
  faults->Add(field, absl::StrCat(value, unit),
              absl::StrCat("a finite number of at most ", largest, unit));
}

void CheckVector(const v1::Vector3& vector, const std::string& field, FaultList* faults) {
  CheckSize(vector.x(), kLargestLength_m, field + ".x", faults);
  CheckSize(vector.y(), kLargestLength_m, field + ".y", faults);
  CheckSize(vector.z(), kLargestLength_m, field + ".z", faults);
}

void CheckQuaternion(const v1::Quaternion& q, const std::string& field, FaultList* faults) {
  CheckUnit(q.x(), q.y(), q.z(), q.w(), field, faults);
}

void CheckPose(const v1::Pose& pose, const std::string& field, FaultList* faults) {
  CheckSize(pose.x_m(), kLargestLength_m, field + ".x_m", faults);
  CheckSize(pose.y_m(), kLargestLength_m, field + ".y_m", faults);
  CheckSize(pose.z_m(), kLargestLength_m, field + ".z_m", faults);
  CheckUnit(pose.qx(), pose.qy(), pose.qz(), pose.qw(), field, faults);
}

}  // namespace truepose::convert
