// Whether files are of one robot, by its name: robots of one model have equal nominals, and what is
// measured of one is wrong of the next.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "formats/robot_file.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::cli {

// "robots/ur10" of a robot file; "" of URDF, whose name is that of a model.
std::string NameOfRobot(const formats::RobotFile& robot);

// The robot of which it was made, from its name or its nominal revision; "" where neither tells, as
// of files that older versions wrote.
std::string RobotOfCalibration(const v1::Calibration& calibration);

// A file that is of one robot.
struct OfRobot {
  std::string path;   // the fault's field
  std::string what;   // "a calibration"
  std::string robot;  // robots/{robot}; "" = not known
};

// @returns kInvalidArgument with one fault when both names are known and differ: `a calibration of
// robots/ur10`, expected `one of robots/ur10-7 (--robot ur10-7.yaml)`.
absl::Status CheckSameRobot(const OfRobot& file, const formats::RobotFile& robot,
                            const std::string& robot_path);

}  // namespace truepose::cli
