// Which poses a recalibration measures.
#pragma once

#include <optional>
#include <string>
#include <type_traits>

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

// What a closure returns that has found out that it needs poses.
absl::Status NeedPoses();
bool IsNeedPoses(const absl::Status& status);

// Poses take long to choose and are seldom needed: `attempt(const PosesToMeasure*)`, which writes
// and returns a StatusOr, is called with nullptr, and when it returns NeedPoses() once more with
// the robot's.
template <typename Attempt>
auto WithPoses(store::Store& store, const std::string& robot, Attempt attempt)
    -> std::invoke_result_t<Attempt&, const PosesToMeasure*> {
  auto result = attempt(nullptr);
  if (!IsNeedPoses(result.status())) return result;
  const absl::StatusOr<PosesToMeasure> poses = PlanPoses(store, robot, "");
  if (!poses.ok()) return poses.status();
  return attempt(&*poses);
}

}  // namespace truepose::services
