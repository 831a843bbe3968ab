#include "client/agent/delivery/audit.h"

#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

using Clock = std::chrono::system_clock;

absl::StatusOr<bool> IsSealedThere(const client::Client& client, const std::string& name) {
  v1::GetSessionRequest request;
  request.set_name(name);
  const auto session = client.GetSession(request);
  if (absl::IsNotFound(session.status())) return false;
  TRUEPOSE_RETURN_IF_ERROR(session.status());
  return session->state() == v1::SEALED;
}

}  // namespace

absl::StatusOr<Audited> AuditDone(const client::Client& client, Spool& spool,
                                  const DoneSession& done, std::chrono::seconds keep) {
  TRUEPOSE_ASSIGN_OR_RETURN(const bool sealed, IsSealedThere(client, done.session));
  if (!sealed) {
    TRUEPOSE_RETURN_IF_ERROR(spool.Reopen(done.session).status());
    return Audited::kReopened;
  }
  if (Clock::now() - done.sealed <= keep) return Audited::kKept;
  TRUEPOSE_RETURN_IF_ERROR(spool.Remove(done.session));
  return Audited::kRemoved;
}

void RemoveEmptySessions(Spool& spool, std::chrono::seconds keep, EmptySince& since) {
  const auto now = std::chrono::steady_clock::now();
  EmptySince still;
  for (const Spool::Session& session : spool.Sessions()) {
    if (session->readings() > 0) continue;
    const std::string& name = session->content().name();
    const auto seen = since.emplace(name, now).first->second;
    // One that gets its first reading at this moment stays.
    const bool removed = now - seen > keep && spool.RemoveEmpty(name).ok();
    if (!removed) still[name] = seen;
  }
  since = std::move(still);
}

}  // namespace truepose::agent
