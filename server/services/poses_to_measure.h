// Which poses a recalibration measures.
#pragma once

#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "server/store/store.h"
#include "truepose/v1/plant.pb.h"

namespace truepose::services {

inline constexpr int kDefaultPoses = 20;

// One of the three is set.
struct PosesToMeasure {
  std::string pose_set;                // one that is stored
  std::optional<v1::PoseSet> thinned;  // one to be stored with the request
  std::string missing;                 // why there are none
};

// `asked` when it isn't "", else that of a policy of the robot, else the poses of the active
// calibration's sessions, thinned (convert/pose_thinning.h) to as many as a policy says or
// kDefaultPoses, at most those there are. Computes: not to be called within a closure of the store.
// @returns kNotFound for `robot` (field `parent`) and for `asked` (field
// `recalibration_request.pose_set`); kInvalidArgument for an `asked` of another robot.
absl::StatusOr<PosesToMeasure> PlanPoses(store::Store& store, const std::string& robot,
                                         const std::string& asked);

}  // namespace truepose::services
