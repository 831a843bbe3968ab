#include "convert/usable_readings.h"

#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "core/base/fault.h"

namespace truepose::convert {
namespace {

// The kinds of columns that any row of the sessions fills.
std::string FoundText(const std::vector<const v1::SessionInput*>& sessions) {
  bool joints = false, position = false, orientation = false, axis = false, points = false,
       distance = false, feature = false;
  for (const v1::SessionInput* session : sessions) {
    for (const v1::Reading& reading : session->readings()) {
      joints = joints || !reading.joints_measured().empty() || !reading.joints_commanded().empty();
      position = position || reading.has_position_m();
      orientation = orientation || reading.has_orientation();
      axis = axis || reading.has_axis();
      points = points || !reading.points().empty();
      distance = distance || reading.has_distance_m();
      feature = feature || !reading.feature().empty();
    }
  }
  std::vector<std::string> found;
  const auto add = [&found](bool is, const char* name) {
    if (is) found.emplace_back(name);
  };
  add(joints, "joints"), add(position, "position"), add(orientation, "orientation");
  add(axis, "axis"), add(points, "points"), add(distance, "distance"), add(feature, "feature");
  return found.empty() ? "no values" : absl::StrJoin(found, ", ");
}

std::string NeededText(const v1::CalibrationOptions& options) {
  std::string joints = "q1_rad...";
  if (options.joints() == "measured") joints = "measured joints (q1_rad...)";
  if (options.joints() == "commanded") joints = "commanded joints (q1_cmd_rad...)";
  const std::string row = absl::StrCat("in a row ", joints, " and ");
  if (options.observe() == v1::POSE)
    return row + "position with orientation (x_mm, y_mm, z_mm, qx, qy, qz, qw)";
  if (options.observe() == v1::POINT_AXIS)
    return row + "position with axis (x_mm, y_mm, z_mm, axis_x, axis_y, axis_z) or orientation";
  if (options.observe() == v1::POINT) return row + "position (x_mm, y_mm, z_mm)";
  return row +
         "position (x_mm, y_mm, z_mm), with orientation (qx, qy, qz, qw) or axis (axis_x...) "
         "where there is one, or distance (distance_mm, anchor); contacts need --fixture FILE and "
         "--feature-column COLUMN";
}

}  // namespace

absl::Status CheckUsable(const std::vector<const v1::SessionInput*>& sessions,
                         const v1::CalibrationOptions& options, size_t usable) {
  if (usable > 0) return absl::OkStatus();
  int rows = 0;
  for (const v1::SessionInput* session : sessions) rows += session->readings_size();
  return FaultStatus(
      "readings",
      absl::StrCat("none that can be used in ", rows, " rows with ", FoundText(sessions)),
      NeededText(options));
}

}  // namespace truepose::convert
