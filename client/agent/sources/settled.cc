#include "client/agent/sources/settled.h"

#include <cmath>

#include "absl/time/time.h"

namespace truepose::agent {
namespace {

std::vector<double> JointsOf(const v1::Reading& reading) {
  const auto& joints =
      reading.joints_measured().empty() ? reading.joints_commanded() : reading.joints_measured();
  return {joints.begin(), joints.end()};
}

bool HasMeasurement(const v1::Reading& reading) {
  return reading.has_position_m() || reading.has_orientation() || reading.has_axis() ||
         reading.has_distance_m() || reading.points_size() > 0 || !reading.feature().empty();
}

}  // namespace

bool Settled::IsNear(const std::vector<double>& joints) const {
  if (joints.size() != rest_.size()) return false;
  for (size_t j = 0; j < joints.size(); ++j) {
    if (!(std::abs(joints[j] - rest_[j]) <= options_.tolerance)) return false;
  }
  return true;
}

bool Settled::Add(const v1::Reading& reading, absl::Time time) {
  std::vector<double> joints = JointsOf(reading);
  const bool goes_on = time >= last_ && IsNear(joints);
  last_ = time;
  if (!goes_on) {
    rest_ = std::move(joints);
    since_ = time;
    taken_ = false;
  }
  if (taken_ || !HasMeasurement(reading) || time - since_ < absl::FromChrono(options_.still))
    return false;
  taken_ = true;
  return true;
}

std::optional<absl::Time> TimeOf(const v1::Reading& reading) {
  absl::Time time;
  std::string error;
  if (!absl::ParseTime(absl::RFC3339_full, reading.time(), &time, &error)) return std::nullopt;
  return time;
}

}  // namespace truepose::agent
