#include "server/services/sessions.h"

#include <vector>

#include "absl/strings/str_cat.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/services/closures.h"
#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/robots.h"
#include "server/store/sessions.h"

namespace truepose::services {
namespace {

using store::Snapshot;
using store::Transaction;

// Which session a stream is for, and that robot's nominal. The first message names it.
absl::Status BeginAppend(const CallContext& call, const std::string& session, AppendState& state) {
  TRUEPOSE_RETURN_IF_ERROR(store::ParseSessionName(session, "session").status());
  TRUEPOSE_ASSIGN_OR_RETURN(const auto revision, call.store.Read([&](Snapshot& snapshot) {
    const absl::StatusOr<v1::Session> found = store::GetSession(snapshot, session);
    if (!found.ok()) return absl::StatusOr<v1::NominalRevision>(found.status());
    return store::GetNominalRevision(snapshot, found->nominal_revision());
  }));
  state.nominal = revision.nominal();
  state.session = session;
  return absl::OkStatus();
}

absl::Status CheckBatch(const AppendState& state, const v1::AppendReadingsRequest& request) {
  if (!request.session().empty() && request.session() != state.session) {
    return FaultStatus("session", request.session(),
                       absl::StrCat(state.session, " as in the first message"));
  }
  const int count = request.readings_size();
  if (count > kMostReadingsOfBatch) {
    return FaultStatus("readings", absl::StrCat(count),
                       absl::StrCat("at most ", kMostReadingsOfBatch, " a message"));
  }
  if (count > 0 && request.readings(0).row() < 0) {
    return FaultStatus("readings[0].row", absl::StrCat(request.readings(0).row()),
                       "rows that count from 0");
  }
  return absl::OkStatus();
}

absl::Status CheckReadings(const AppendState& state, const v1::AppendReadingsRequest& request) {
  if (request.readings().empty()) return absl::OkStatus();
  const std::vector<v1::Reading> readings(request.readings().begin(), request.readings().end());
  return convert::ValidateReadings(state.nominal, readings, readings.front().row());
}

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

absl::StatusOr<v1::AppendReadingsResponse> AppendReadings(
    const CallContext& call, AppendState& state, const v1::AppendReadingsRequest& request) {
  if (state.session.empty()) TRUEPOSE_RETURN_IF_ERROR(BeginAppend(call, request.session(), state));
  TRUEPOSE_RETURN_IF_ERROR(CheckBatch(state, request));
  TRUEPOSE_RETURN_IF_ERROR(CheckReadings(state, request));
  TRUEPOSE_ASSIGN_OR_RETURN(const int count, call.store.Write([&](Transaction& transaction) {
    return store::AppendReadings(transaction, state.session, request.readings());
  }));
  v1::AppendReadingsResponse response;
  response.set_reading_count(count);
  return response;
}

}  // namespace truepose::services
