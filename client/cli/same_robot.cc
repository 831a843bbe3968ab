#include "client/cli/same_robot.h"

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "client/cli/names.h"
#include "core/base/fault.h"

namespace truepose::cli {

std::string NameOfRobot(const formats::RobotFile& robot) {
  // Only YAML has lines.
  return robot.lines.LineOf("joints") == 0 ? "" : RobotName(robot.robot_id);
}

std::string RobotOfCalibration(const v1::Calibration& calibration) {
  for (const std::string& name : {calibration.name(), calibration.nominal_revision()})
    if (absl::StartsWith(name, "robots/")) return RobotOf(name);
  return "";
}

absl::Status CheckSameRobot(const OfRobot& file, const formats::RobotFile& robot,
                            const std::string& robot_path) {
  const std::string expected = NameOfRobot(robot);
  if (file.robot.empty() || expected.empty() || file.robot == expected) return absl::OkStatus();
  return FaultStatus(file.path, absl::StrCat(file.what, " of ", file.robot),
                     absl::StrCat("one of ", expected, " (--robot ", robot_path, ")"));
}

}  // namespace truepose::cli
