// A robot, nominal or calibrated, as a file of another program: `robot export` and `calibration
// export` differ only in where the robot comes from.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "client/cli/command_line.h"
#include "formats/robot_file.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::cli {

struct ExportOptions {
  std::string format;  // urdf, dh, robot or ur_calibration
  std::string output;  // "" = standard output
};

// Adds --format and --output to a command.
void AddExportOptions(const Command& command, ExportOptions* options);

// A fault of `--format` for any other; told before anything is fetched.
absl::Status CheckFormat(const ExportOptions& options);

// Writes the file, or prints it; with --json the message that it was made from. Warnings go to
// console.err.
// @param calibration nullptr for the nominal robot.
absl::Status Export(const Invocation& invocation, const ExportOptions& options,
                    const formats::RobotFile& robot, const v1::Calibration* calibration);

}  // namespace truepose::cli
