#include "client/agent/released/pose_json.h"

#include <cmath>
#include <numbers>

#include "absl/strings/str_cat.h"

namespace truepose::agent {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMillimetre = 1e-3;
// Controllers print rounded quaternions.
constexpr double kNormalisedWithin = 1e-3;

using Numbers = std::optional<std::vector<double>>;

// Null counts as nothing: it has no fault of its own.
bool IsGiven(const JsonFields& fields, const char* key) {
  return fields.Has(key) && !fields.object().at(key).is_null();
}

// The one of two keys that is there; a fault when it is none or both.
Numbers OneOf(JsonFields& fields, const char* si, const char* other, size_t size, double factor) {
  const bool has_si = IsGiven(fields, si), has_other = IsGiven(fields, other);
  const Numbers in_si = fields.Numbers(si, size), in_other = fields.Numbers(other, size, factor);
  if (has_si == has_other)
    fields.AddFault(si, has_si ? absl::StrCat("beside ", other) : "nothing",
                    absl::StrCat(si, " or ", other));
  return has_si ? in_si : in_other;
}

Eigen::Matrix3d Turn(const Eigen::Vector3d& axis, double angle) {
  return ExpRotation<double>(axis * angle);
}

void SetFromQuaternion(JsonFields& fields, const std::vector<double>& q, Eigen::Matrix3d* R) {
  const Eigen::Vector4d quaternion(q[0], q[1], q[2], q[3]);
  const double length = quaternion.norm();
  if (std::abs(length - 1) <= kNormalisedWithin)
    *R = RotationOf<double>(quaternion / length);
  else
    fields.AddFault("quaternion", absl::StrCat("length ", length), "[x, y, z, w] of length 1");
}

Eigen::Matrix3d RotationFromJson(JsonFields& fields) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  const Numbers quaternion = fields.Numbers("quaternion", 4),
                vector = fields.Numbers("rotation_vector", 3),
                abc = fields.Numbers("abc_deg", 3, kDegree);
  const int given = IsGiven(fields, "quaternion") + IsGiven(fields, "rotation_vector") +
                    IsGiven(fields, "abc_deg");
  if (given != 1)
    fields.AddFault("quaternion", given == 0 ? "nothing" : "more than one orientation",
                    "one of quaternion, rotation_vector and abc_deg");
  if (quaternion.has_value()) SetFromQuaternion(fields, *quaternion, &R);
  if (vector.has_value())
    R = ExpRotation<double>(Eigen::Vector3d((*vector)[0], (*vector)[1], (*vector)[2]));
  if (abc.has_value())
    R = Turn(Eigen::Vector3d::UnitZ(), (*abc)[0]) * Turn(Eigen::Vector3d::UnitY(), (*abc)[1]) *
        Turn(Eigen::Vector3d::UnitX(), (*abc)[2]);
  return R;
}

}  // namespace

Pose PoseFromJson(JsonFields& fields) {
  Pose pose;
  const Numbers p = OneOf(fields, "position_m", "position_mm", 3, kMillimetre);
  if (p.has_value()) pose.p = {(*p)[0], (*p)[1], (*p)[2]};
  pose.R = RotationFromJson(fields);
  return pose;
}

std::vector<double> JointsFromJson(JsonFields& fields, size_t size) {
  return OneOf(fields, "joints", "joints_deg", size, kDegree).value_or(std::vector<double>(size));
}

}  // namespace truepose::agent
