#include "server/services/sessions.h"

#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/services/closures.h"
#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/sessions.h"

namespace truepose::services {
namespace {

using store::Snapshot;
using store::Transaction;

}  // namespace

absl::StatusOr<v1::Session> CreateSession(const CallContext& call,
                                          const v1::CreateSessionRequest& request) {
  FaultList faults;
  faults.AddAll(store::CheckUuid(request.session_id(), "session_id"));
  faults.AddAll(store::ParseRobotName(request.session().robot(), "session.robot").status());
  if (const std::string& revision = request.session().nominal_revision(); !revision.empty()) {
    faults.AddAll(store::ParseNominalName(revision, "session.nominal_revision").status());
  }
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  return call.store.Write([&](Transaction& transaction) {
    return store::CreateSession(transaction, request.session_id(), request.session());
  });
}

absl::StatusOr<v1::Session> GetSession(const CallContext& call,
                                       const v1::GetSessionRequest& request) {
  return call.store.Read(
      [&](Snapshot& snapshot) { return store::GetSession(snapshot, request.name()); });
}

absl::StatusOr<v1::ListSessionsResponse> ListSessions(const CallContext& call,
                                                      const v1::ListSessionsRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(auto page, call.store.Read([&](Snapshot& snapshot) {
    return store::ListSessions(snapshot, request.robot(), PageOf(request));
  }));
  return ToResponse(std::move(page), &v1::ListSessionsResponse::mutable_sessions);
}

absl::StatusOr<v1::Session> SealSession(const CallContext& call,
                                        const v1::SealSessionRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(store::ParseSessionName(request.name()).status());
  // The digest takes a while and is made beside the writer: stored rows never change, and a row
  // that comes in between makes the count differ, which the store refuses.
  TRUEPOSE_ASSIGN_OR_RETURN(const auto readings, call.store.Read([&](Snapshot& snapshot) {
    return store::AllReadings(snapshot, request.name());
  }));
  const std::string digest = convert::ReadingsDigest(readings);
  return call.store.Write([&](Transaction& transaction) {
    return store::SealSession(transaction, request.name(), request.reading_count(), digest);
  });
}

absl::StatusOr<v1::ListReadingsResponse> ListReadings(const CallContext& call,
                                                      const v1::ListReadingsRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(store::ParseSessionName(request.session(), "session").status());
  TRUEPOSE_ASSIGN_OR_RETURN(auto page, call.store.Read([&](Snapshot& snapshot) {
    return store::ListReadings(snapshot, request.session(), PageOf(request));
  }));
  return ToResponse(std::move(page), &v1::ListReadingsResponse::mutable_readings);
}

}  // namespace truepose::services
