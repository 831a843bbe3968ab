// Robot files: YAML with units in the key names (docs/formats.md) <-> v1::Nominal in m and rad.
//
// Checked here is what the text can tell: keys, types, units, counts, names. What needs kinematics
// is checked by convert::ValidateNominal; LocateFaults(status, file.lines) gives its faults the
// lines of the file.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "formats/field_lines.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::formats {

struct RobotFile {
  std::string robot_id;  // [a-z0-9][a-z0-9-]{0,62}
  v1::Nominal nominal;
  FieldLines lines;  // of the fields of `nominal`; empty for a robot that was not read from a file
};

// @returns kNotFound or kPermissionDenied with one fault that names the path when it can't be read;
//   kInvalidArgument with all faults of the content, each as `path:line: field`, found, expected.
absl::StatusOr<RobotFile> ReadRobotFile(const std::string& path);

// The same for text in memory; `file_name` stands before the line in faults.
absl::StatusOr<RobotFile> ParseRobotFile(std::string_view text, std::string_view file_name);

// YAML that reads back with equal robot_id and nominal, bit for bit: in mm and deg where these
// digits give the same bits, else in m and rad. Needs a nominal as ParseRobotFile makes them (unit
// quaternions with qw >= 0, known types).
std::string WriteRobotFile(const RobotFile& file);

}  // namespace truepose::formats
