// Files named on the command line become messages. Whatever is wrong with a file is
// kInvalidArgument with all its faults, each with file and line where the file has lines.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/cli/console.h"
#include "formats/robot_file.h"
#include "formats/session_file.h"
#include "formats/urdf.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/session.pb.h"

namespace truepose::cli {

// A robot file, YAML or URDF, whose content convert::ValidateNominal accepts.
// @param ends of a URDF file's chain: --urdf-base and --urdf-tip.
absl::StatusOr<formats::RobotFile> LoadRobot(const std::string& path,
                                             const formats::UrdfEnds& ends = {});

inline constexpr char kUrdfBaseHelp[] = "Of a URDF file: the link of the base; default: the root";
inline constexpr char kUrdfTipHelp[] =
    "Of a URDF file: the link of the flange; default: the only link without a joint below it";

// A UsageError when ends were given to a command that reads no robot file.
absl::Status CheckNoEnds(const formats::UrdfEnds& ends);

// Session files for that robot, or the faults of all of them. A session's name is its path; its
// robot is not set. What the reader of a file warns of goes to console.err.
absl::StatusOr<std::vector<v1::SessionInput>> LoadSessions(
    const std::vector<std::string>& paths, const v1::Nominal& nominal,
    const formats::SessionFileOptions& options, const Console& console);

// Joints beyond their limits: warnings on console.err, with `strict` faults.
absl::Status CheckLimits(const v1::Nominal& nominal, const v1::SessionInput& session, bool strict,
                         const Console& console);

// A fixture file whose content convert::ValidateFixture accepts.
absl::StatusOr<v1::Fixture> LoadFixture(const std::string& path);

// A file that `calibrate --output` wrote (or `simulate --truth`).
absl::StatusOr<v1::Calibration> LoadCalibration(const std::string& path);

// "pose", "point", "point_axis" or "" of the option --observe.
absl::StatusOr<v1::Observe> ParseObserve(const std::string& text);

// What Calibration.nominal_revision is for a robot that no server knows: "sha256:" and the
// nominal's digest, behind "robots/ur10/nominals/" where the robot has a name.
std::string LocalRevision(const formats::RobotFile& robot);

// A calibration made from another robot file, or whose file was changed, is a fault of `--robot`:
// its digest does not fit. A simulated truth has no digest and is told by its revision.
absl::Status CheckBelongsTogether(const v1::Calibration& calibration,
                                  const formats::RobotFile& robot, const std::string& robot_path);

// What --robot and --calibration name of a command that works without a server.
struct LocalCalibration {
  formats::RobotFile robot;
  v1::Calibration calibration;
};

// @returns a UsageError without a robot file; faults of either file; those of CheckBelongsTogether
// and, as robots of one model have equal nominals, of CheckSameRobot (same_robot.h).
absl::StatusOr<LocalCalibration> LoadLocalCalibration(const std::string& robot_path,
                                                      const formats::UrdfEnds& ends,
                                                      const std::string& calibration_path);

// CheckBelongsTogether of a calibration that is to be the prior of another one, as a fault of
// `--prior`.
absl::Status CheckPrior(const v1::Calibration& calibration, const v1::Nominal& nominal);

}  // namespace truepose::cli
