// The tree of links and joints of a URDF file, by urdfdom, and a path through it. Only the files
// urdf_*.cc see urdfdom's types.
#pragma once

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/urdf.h"

namespace truepose::formats {

// Parses a text that comes from anywhere: urdfdom's reader descends by recursion, so nesting deeper
// than 100 and more than 2000 links are refused before it sees them. What it would print are faults
// of `file_name`.
absl::StatusOr<urdf::ModelInterfaceSharedPtr> ParseUrdfTree(std::string_view text,
                                                            std::string_view file_name);

struct UrdfPath {
  urdf::LinkConstSharedPtr base;
  std::vector<urdf::JointConstSharedPtr> joints;  // from base to tip, fixed ones included
};

// @returns kInvalidArgument with one fault: see ParseUrdf.
absl::StatusOr<UrdfPath> FindUrdfPath(const urdf::ModelInterface& model, const UrdfEnds& ends,
                                      std::string_view file_name);

}  // namespace truepose::formats
