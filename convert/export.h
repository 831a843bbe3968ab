// A robot, nominal or as a calibration identified it, for other programs: messages from which
// formats/ writes URDF, D&H tables, robot files and UR's calibration file. All go through
// core/export, so any model with any parameter values is exported alike, and all give X_BF(q) as
// the calibration does up to rounding.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::convert {

// A nominal whose geometry is that of the robot as identified. Names, limits, kind and tools are
// those of the nominal it came from.
struct ExportedRobot {
  v1::Nominal nominal;
  std::vector<std::string> warnings;
};

struct ExportedDh {
  v1::DhTable table;  // of B, of the joints, of the flange: n + 2 rows (formats/dh_table.h)
  std::vector<std::string> warnings;
};

// In all of them @param calibration may be nullptr: the nominal itself is exported.
// @returns kInvalidArgument with faults of the nominal or of a calibration that is of another
//   robot; of `effects`, for a calibration with joint effects that are not 0: none of these formats
//   can hold them, and the geometry identified beside them is not the best one without them;
//   kFailedPrecondition for a calibration whose verdict is do_not_apply.

// A chain of joint frames (formats/joint_origins.h) in the controller's joints, without joint map,
// masses and tools: what URDF can say. Also a fault of `joint_map.scale` when the controller
// couples or scales joints.
absl::StatusOr<ExportedRobot> ExportJointFrames(const v1::Nominal& nominal,
                                                const v1::Calibration* calibration);

// The table in the chain's joints. A warning for each d beyond 10 m, which nearly parallel axes
// have, and for a joint map. A fault for a d beyond 10 km.
absl::StatusOr<ExportedDh> ExportDhTable(const v1::Nominal& nominal,
                                         const v1::Calibration* calibration);

// A robot file's content with `standard_dh`; where that can't hold the robot (the axis of joint 1
// is not B's z, a d is beyond 10 km) with a `chain` of joint frames, and a warning that says so.
absl::StatusOr<ExportedRobot> ExportRobot(const v1::Nominal& nominal,
                                          const v1::Calibration* calibration);

// Only for a robot that is UR-like: six revolute joints whose nominal standard D&H table in the
// controller's joints has, within 1e-6 (m, rad), theta 0 everywhere, alpha 90, 0, 0, 90, -90, 0
// deg, a only in rows 2 and 3, d in none of these two, and nothing before joint 1 or behind
// joint 6. B is then the controller's base frame. The frames of the links are those of
// ur_description on the nominal robot, each moved to its identified axis.
// @returns kInvalidArgument with a fault of `robot` for another robot.
absl::StatusOr<ExportedRobot> ExportUrCalibration(const v1::Nominal& nominal,
                                                  const v1::Calibration* calibration);

// `calib_` and a number that is another one for another robot or calibration.
std::string UrHash(const v1::Nominal& nominal, const v1::Calibration* calibration);

}  // namespace truepose::convert
