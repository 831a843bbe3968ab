// Handlers of RobotService (proto/truepose/v1/services.proto). Each checks its request, then runs
// one store closure.
// @returns kInvalidArgument with every fault of the request and its field path; kNotFound for a
// name that is well
//   formed and unknown; what the store says else. Nothing is stored on failure or with
//   validate_only.
#pragma once

#include "absl/status/statusor.h"
#include "server/services/call_context.h"
#include "truepose/v1/services.pb.h"

namespace truepose::services {

absl::StatusOr<v1::Robot> CreateRobot(const CallContext& call,
                                      const v1::CreateRobotRequest& request);
absl::StatusOr<v1::Robot> UpdateRobot(const CallContext& call,
                                      const v1::UpdateRobotRequest& request);
absl::StatusOr<v1::Robot> DeleteRobot(const CallContext& call,
                                      const v1::DeleteRobotRequest& request);
absl::StatusOr<v1::Robot> UndeleteRobot(const CallContext& call,
                                        const v1::UndeleteRobotRequest& request);
absl::StatusOr<v1::Robot> GetRobot(const CallContext& call, const v1::GetRobotRequest& request);
absl::StatusOr<v1::ListRobotsResponse> ListRobots(const CallContext& call,
                                                  const v1::ListRobotsRequest& request);
absl::StatusOr<v1::NominalRevision> CreateNominalRevision(
    const CallContext& call, const v1::CreateNominalRevisionRequest& request);
absl::StatusOr<v1::NominalRevision> GetNominalRevision(
    const CallContext& call, const v1::GetNominalRevisionRequest& request);
absl::StatusOr<v1::ListNominalRevisionsResponse> ListNominalRevisions(
    const CallContext& call, const v1::ListNominalRevisionsRequest& request);

}  // namespace truepose::services
