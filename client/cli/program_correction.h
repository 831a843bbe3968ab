// Where corrected joints come from for the filters of robot programs (programs/correct.h).
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/client.h"
#include "formats/robot_file.h"
#include "programs/correct.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::cli {

// What a program's targets are corrected by, and the joints of the robot that runs it.
struct ProgramCorrection {
  std::vector<bool> prismatic;
  programs::Correction correct;
  std::string calibration;  // its digest in hex; "none" of one without, such as a simulated truth
};

// By a calibration from files. Both messages have to outlive it.
// @returns kInvalidArgument for a measuring robot, which is read and not commanded.
absl::StatusOr<ProgramCorrection> LocalCorrection(const v1::Nominal& nominal,
                                                  const v1::Calibration& calibration);

// By a server, in as many calls as it takes. `client` has to outlive it.
absl::StatusOr<ProgramCorrection> RemoteCorrection(const client::Client& client,
                                                   const v1::Nominal& nominal,
                                                   const v1::Calibration& calibration);

// A robot file as --robot named it.
struct TableRobot {
  std::string path;
  formats::RobotFile file;
};

// By a compensation table (`compensation/`), which needs nothing else.
// @param robot that the table has to be of, by its nominal and, where both are known, its name;
// nullptr = whatever robot it is of.
// @returns kInvalidArgument with a fault of `--table` for a file that is no whole table, or one of
// another robot, or of a measuring one.
absl::StatusOr<ProgramCorrection> TableCorrection(const std::string& path, const TableRobot* robot);

}  // namespace truepose::cli
