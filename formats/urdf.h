// URDF files <-> robots (docs/formats.md, "Other robot files").
//
// Reading takes the serial chain from a base link to a tip link out of the tree that urdfdom
// parses; the frames B and F are those of the two links. Joints keep URDF's zeros and senses. An
// origin becomes up to six constants (joint_origins.h); a fixed joint only these; a joint about an
// axis other than x, y, z turns z to its axis by R(z) R(y), moves, and turns back.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "formats/robot_file.h"

namespace truepose::formats {

struct UrdfEnds {
  std::string base;  // link; "" = the root
  std::string tip;   // link; "" = the only leaf below the base
};

// Whether a file's text is to be read as URDF: it begins as XML does.
bool LooksLikeXml(std::string_view text);

// The robot's id is the `name` of the file in lower case, other letters as `-`; `robot` without
// one. Revolute joints have limits, continuous ones none; limits of 0 and 0, or of 1e4 and more,
// are none. Inertials of links that move with a joint of the chain, also on branches beside it, are
// masses; the branches' own joints count as 0.
// @returns kInvalidArgument with all faults: not XML or not URDF (in urdfdom's words); a link that
//   is not there; a tip that is not below the base; several leaves without a tip; a mimic, floating
//   or planar joint on the chain; an axis of length zero; no movable joint; more than 64 joints.
//   What needs kinematics is checked by convert::ValidateNominal.
absl::StatusOr<RobotFile> ParseUrdf(std::string_view text, std::string_view file_name,
                                    const UrdfEnds& ends);

// A robot file of either kind, told by its content. YAML has no use for `ends`.
// @returns errors of ReadRobotFile and ParseUrdf; kInvalidArgument with one fault for ends beside a
//   YAML file.
absl::StatusOr<RobotFile> ReadRobotOrUrdfFile(const std::string& path, const UrdfEnds& ends);

// A URDF file of a robot whose geometry has the form of joint_origins.h and whose joint map is the
// identity: links `base`, `<joint>_link`..., `flange`. Numbers read back as the same bits. Revolute
// joints without limits are continuous; a missing limit beside a given one, or of a prismatic
// joint, is 1e4, since URDF demands limits there; effort and velocity, which no robot file knows,
// are 0. Tools, masses and meshes are not written.
// @returns kInvalidArgument with one fault for a geometry of another form or a joint map.
absl::StatusOr<std::string> WriteUrdf(const RobotFile& file);

}  // namespace truepose::formats
