#include "server/services/sessions.h"

#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/resource/etag.h"
#include "server/resource/field_mask.h"
#include "server/resource/registry.h"
#include "server/resource/resource_name.h"
#include "server/resource/standard_methods.h"
#include "server/services/closures.h"
#include "server/services/live.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/sessions.h"
#include "truepose/v1/plant.pb.h"

namespace truepose::services {
namespace {

using store::Snapshot;
using store::Transaction;

// Everything else is the server's, or is what the readings were measured for.
const std::vector<std::string>& OutputOnly() {
  static const auto& fields = *new std::vector<std::string>{"robot",
                                                            "nominal_revision",
                                                            "source",
                                                            "extra_columns",
                                                            "state",
                                                            "digest",
                                                            "reading_count",
                                                            "seal_time",
                                                            "sealed_by",
                                                            "created_by",
                                                            "certificate_expired_time"};
  return fields;
}

// The form of what it refers to; a session that was begun offline may name what is registered
// later.
absl::Status CheckReferences(const v1::Session& session) {
  FaultList faults;
  const auto check = [&](const auto* descriptor, const std::string& name, const char* field) {
    if (!name.empty())
      faults.AddAll(resource::ParseName(*resource::FindType(descriptor), name, field).status());
  };
  check(v1::Instrument::descriptor(), session.instrument(), "session.instrument");
  check(v1::RegisteredFixture::descriptor(), session.fixture(), "session.fixture");
  check(v1::Placement::descriptor(), session.placement(), "session.placement");
  return faults.ToStatus();
}

absl::StatusOr<v1::Session> Update(Transaction& transaction,
                                   const v1::UpdateSessionRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(
      store::ParseSessionName(request.session().name(), "session.name").status());
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Session session,
                            store::GetSession(transaction, request.session().name()));
  if (session.has_delete_time()) return store::NotFound(session.name(), "session.name");
  TRUEPOSE_RETURN_IF_ERROR(resource::CheckEtag(session.etag(), request.session().etag()));
  if (session.state() != v1::OPEN) {
    return store::Refusal(absl::StatusCode::kFailedPrecondition, "session.name",
                          absl::StrCat(session.name(), ", which is sealed"), "an open session");
  }
  TRUEPOSE_RETURN_IF_ERROR(
      resource::ApplyUpdate(request.session(), request.update_mask(), OutputOnly(), session));
  TRUEPOSE_RETURN_IF_ERROR(CheckReferences(session));
  return store::PutSession(transaction, session);
}

absl::StatusOr<v1::Session> SetDeleted(Transaction& transaction, const std::string& name,
                                       const std::string& etag, bool deleted) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Session session, store::GetSession(transaction, name));
  TRUEPOSE_RETURN_IF_ERROR(resource::CheckEtag(session.etag(), etag));
  if (session.has_delete_time() == deleted) return session;
  session.clear_delete_time();
  if (deleted) *session.mutable_delete_time() = store::ToTimestamp(transaction.now());
  return store::PutSession(transaction, session);
}

// When the certificate of the session's instrument expired, if it has. An instrument that isn't
// registered has none that is known.
absl::StatusOr<std::optional<google::protobuf::Timestamp>> ExpiredCertificate(
    Transaction& transaction, const std::string& name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Session session, store::GetSession(transaction, name));
  v1::Instrument instrument;
  const absl::Status found =
      resource::Get(transaction, *resource::FindType(v1::Instrument::descriptor()),
                    session.instrument(), "instrument", instrument);
  if (absl::IsNotFound(found) || absl::IsInvalidArgument(found)) return std::nullopt;
  TRUEPOSE_RETURN_IF_ERROR(found);
  const auto& expires = instrument.certificate_expire_time();
  if (!instrument.has_certificate_expire_time() ||
      expires.seconds() >= absl::ToUnixSeconds(transaction.now()))
    return std::nullopt;
  return expires;
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
  faults.AddAll(CheckReferences(request.session()));
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  v1::Session session = request.session();
  session.set_created_by(call.caller.principal);
  return WriteOnce(call, request, [&](Transaction& transaction) -> absl::StatusOr<v1::Session> {
    TRUEPOSE_RETURN_IF_ERROR(GetLiveRobot(transaction, session.robot(), "session.robot").status());
    return store::CreateSession(transaction, request.session_id(), session);
  });
}

absl::StatusOr<v1::Session> UpdateSession(const CallContext& call,
                                          const v1::UpdateSessionRequest& request) {
  return WriteOnce(call, request,
                   [&](Transaction& transaction) { return Update(transaction, request); });
}

absl::StatusOr<v1::Session> DeleteSession(const CallContext& call,
                                          const v1::DeleteSessionRequest& request) {
  return WriteOnce(call, request, [&](Transaction& transaction) {
    return SetDeleted(transaction, request.name(), request.etag(), true);
  });
}

absl::StatusOr<v1::Session> UndeleteSession(const CallContext& call,
                                            const v1::UndeleteSessionRequest& request) {
  return WriteOnce(call, request, [&](Transaction& transaction) {
    return SetDeleted(transaction, request.name(), "", false);
  });
}

absl::StatusOr<v1::Session> GetSession(const CallContext& call,
                                       const v1::GetSessionRequest& request) {
  return call.store.Read(
      [&](Snapshot& snapshot) { return store::GetSession(snapshot, request.name()); });
}

absl::StatusOr<v1::ListSessionsResponse> ListSessions(const CallContext& call,
                                                      const v1::ListSessionsRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto filter, FilterOf<v1::Session>(request));
  TRUEPOSE_ASSIGN_OR_RETURN(auto page, call.store.Read([&](Snapshot& snapshot) {
    return store::ListSessions(snapshot, request.robot(), PageOf(request), filter);
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
  return WriteOnce(call, request, [&](Transaction& transaction) -> absl::StatusOr<v1::Session> {
    TRUEPOSE_ASSIGN_OR_RETURN(const auto expired, ExpiredCertificate(transaction, request.name()));
    return store::SealSession(transaction, request.name(), request.reading_count(), digest,
                              {call.caller.principal, expired});
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
