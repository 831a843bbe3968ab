#include "server/services/robots.h"

#include <string>

#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/services/closures.h"
#include "server/store/names.h"
#include "server/store/robots.h"

namespace truepose::services {

using store::Snapshot;
using store::Transaction;

absl::StatusOr<v1::Robot> CreateRobot(const CallContext& call,
                                      const v1::CreateRobotRequest& request) {
  FaultList faults;
  faults.AddAll(store::CheckRobotId(request.robot_id(), "robot_id"));
  faults.AddAll(convert::ValidateNominal(request.nominal()), "nominal.");
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  const std::string digest = convert::NominalDigest(request.nominal());
  return WriteUnless(request.validate_only(), call.store, [&](Transaction& transaction) {
    return store::CreateRobot(transaction, request.robot_id(), request.nominal(), digest);
  });
}

absl::StatusOr<v1::Robot> GetRobot(const CallContext& call, const v1::GetRobotRequest& request) {
  return call.store.Read(
      [&](Snapshot& snapshot) { return store::GetRobot(snapshot, request.name()); });
}

absl::StatusOr<v1::ListRobotsResponse> ListRobots(const CallContext& call,
                                                  const v1::ListRobotsRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(auto page, call.store.Read([&](Snapshot& snapshot) {
    return store::ListRobots(snapshot, PageOf(request));
  }));
  return ToResponse(std::move(page), &v1::ListRobotsResponse::mutable_robots);
}

absl::StatusOr<v1::NominalRevision> CreateNominalRevision(
    const CallContext& call, const v1::CreateNominalRevisionRequest& request) {
  FaultList faults;
  faults.AddAll(store::ParseRobotName(request.parent(), "parent").status());
  faults.AddAll(convert::ValidateNominal(request.nominal()), "nominal.");
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  const std::string digest = convert::NominalDigest(request.nominal());
  return WriteUnless(request.validate_only(), call.store, [&](Transaction& transaction) {
    return store::AddNominalRevision(transaction, request.parent(), request.nominal(), digest);
  });
}

absl::StatusOr<v1::NominalRevision> GetNominalRevision(
    const CallContext& call, const v1::GetNominalRevisionRequest& request) {
  return call.store.Read(
      [&](Snapshot& snapshot) { return store::GetNominalRevision(snapshot, request.name()); });
}

absl::StatusOr<v1::ListNominalRevisionsResponse> ListNominalRevisions(
    const CallContext& call, const v1::ListNominalRevisionsRequest& request) {
  // The store calls the field `robot_name`, this request calls it `parent`.
  TRUEPOSE_RETURN_IF_ERROR(store::ParseRobotName(request.parent(), "parent").status());
  TRUEPOSE_ASSIGN_OR_RETURN(auto page, call.store.Read([&](Snapshot& snapshot) {
    return store::ListNominalRevisions(snapshot, request.parent(), PageOf(request));
  }));
  return ToResponse(std::move(page), &v1::ListNominalRevisionsResponse::mutable_nominal_revisions);
}

}  // namespace truepose::services
