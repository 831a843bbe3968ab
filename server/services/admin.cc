#include "server/services/admin.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/auth/secret.h"
#include "server/resource/once.h"
#include "server/services/administration.h"
#include "server/services/closures.h"
#include "server/store/checksum.h"
#include "server/store/message.h"
#include "server/store/replies.h"
#include "server/store/tally.h"
#include "server/store/tokens.h"

namespace truepose::services {
namespace {

using store::Snapshot;
using store::Transaction;

constexpr size_t kLongestPrincipal = 63;
constexpr char kBootstrap[] = "bootstrap";

bool IsLowerOrDigit(char c) { return absl::ascii_islower(c) || absl::ascii_isdigit(c); }

bool IsPrincipal(const std::string& text) {
  if (text.empty() || text.size() > kLongestPrincipal || !IsLowerOrDigit(text[0])) return false;
  return std::all_of(text.begin(), text.end(), [](char c) {
    return IsLowerOrDigit(c) || c == '.' || c == '_' || c == '@' || c == '-';
  });
}

// What the server writes where nobody's token stood behind it.
bool IsOurs(const std::string& principal) {
  return principal == auth::kLocalDev || principal == "server" || principal == kBootstrap;
}

void CheckPrincipal(const std::string& principal, const std::string& field, FaultList& faults) {
  if (!IsPrincipal(principal))
    faults.Add(field, absl::StrCat("'", principal, "'"), "[a-z0-9][a-z0-9._@-]{0,62}");
  if (IsOurs(principal))
    faults.Add(field, absl::StrCat("'", principal, "', which is the server's own"), "another name");
}

absl::Status CheckContent(const v1::Token& token, absl::Time now) {
  FaultList faults;
  CheckPrincipal(token.principal(), "token.principal", faults);
  if (token.kind() != v1::PERSON && token.kind() != v1::MACHINE)
    faults.Add("token.kind", v1::PrincipalKind_Name(token.kind()), "PERSON or MACHINE");
  if (token.admin() && token.kind() == v1::MACHINE)
    faults.Add("token.admin", "an admin that is a MACHINE", "a PERSON");
  if (token.has_expire_time() && absl::FromUnixSeconds(token.expire_time().seconds()) <= now)
    faults.Add("token.expire_time", "a time that has passed", "one to come, or none");
  return faults.ToStatus();
}

absl::Status CheckKind(Snapshot& snapshot, const v1::Token& token) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::PrincipalKind kind,
                            store::KindOfPrincipal(snapshot, token.principal()));
  if (kind == v1::PRINCIPAL_KIND_UNSPECIFIED || kind == token.kind()) return absl::OkStatus();
  return FaultStatus("token.kind", v1::PrincipalKind_Name(token.kind()),
                     absl::StrCat(v1::PrincipalKind_Name(kind), ", which ", token.principal(),
                                  " is, or another principal"));
}

absl::Status CheckAsksForTokens(const CallContext& call) {
  if (!call.administration->authenticator.is_open_to_all()) return absl::OkStatus();
  return store::Refusal(absl::StatusCode::kFailedPrecondition, "server",
                        "one that was started with --dev-open and asks for no tokens",
                        "a start without it");
}

// Of a call that was answered before. A secret that nobody has used was never told, or can't be
// missed: another one takes its place.
absl::StatusOr<v1::Token> GiveNewSecret(Transaction& transaction, const store::RequestKey& key,
                                        const std::string& answered, const std::string& hash) {
  v1::CreateTokenResponse first;
  if (!first.ParseFromString(answered))
    return absl::DataLossError("a stored CreateTokenResponse can't be read");
  TRUEPOSE_ASSIGN_OR_RETURN(const std::optional<v1::Token> token,
                            store::ReplaceUnusedSecret(transaction, first.token().name(), hash));
  if (token.has_value()) return *token;
  return store::Refusal(
      absl::StatusCode::kAlreadyExists, "request_id",
      absl::StrCat(key.request_id, ", whose ", first.token().name(), " was used or revoked since"),
      "another UUID, for another token");
}

// What is kept of the answer has no secret.
absl::StatusOr<v1::Token> InsertOnce(Transaction& transaction, const store::RequestKey& key,
                                     const std::string& hash, const v1::Token& content) {
  std::optional<std::string> answered;
  if (!key.request_id.empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(answered, store::FindReply(transaction, key));
  }
  if (answered.has_value()) return GiveNewSecret(transaction, key, *answered, hash);
  TRUEPOSE_RETURN_IF_ERROR(CheckKind(transaction, content));
  v1::CreateTokenResponse kept;
  TRUEPOSE_ASSIGN_OR_RETURN(*kept.mutable_token(),
                            store::InsertToken(transaction, store::NewUuid(), hash, content));
  if (!key.request_id.empty())
    TRUEPOSE_RETURN_IF_ERROR(store::KeepReply(transaction, key, kept.SerializeAsString()));
  return kept.token();
}

// The secret is made outside of the closure, which may run again.
absl::StatusOr<v1::CreateTokenResponse> Make(const CallContext& call, const store::RequestKey& key,
                                             const v1::Token& content) {
  const std::lock_guard lock(call.administration->new_secret);
  v1::CreateTokenResponse response;
  TRUEPOSE_ASSIGN_OR_RETURN(*response.mutable_secret(), auth::NewSecret());
  const std::string hash = auth::HashOf(response.secret());
  TRUEPOSE_ASSIGN_OR_RETURN(*response.mutable_token(),
                            call.store.Write([&](Transaction& transaction) {
                              return InsertOnce(transaction, key, hash, content);
                            }));
  call.administration->authenticator.Learn({.token = response.token(), .secret_sha256 = hash});
  return response;
}

void FillTally(const store::Tally& tally, v1::ServerStatus& status) {
  status.set_robots(tally.robots);
  status.set_sessions(tally.sessions);
  status.set_readings(tally.readings);
  status.set_pending_jobs(tally.pending_jobs);
  status.set_running_jobs(tally.running_jobs);
  status.set_open_requests(tally.open_requests);
}

void FillFacts(const Administration& administration, v1::ServerStatus& status) {
  const ServerFacts& facts = administration.facts;
  status.set_version(facts.version);
  *status.mutable_start_time() = store::ToTimestamp(facts.start);
  status.set_time_zone(facts.time_zone);
  status.set_dev_open(administration.authenticator.is_open_to_all());
  status.set_database_bytes(facts.database_bytes());
  status.set_watchers(facts.watchers());
}

bool MakesTokens(const v1::Token& token, absl::Time now) {
  const bool expired = token.has_expire_time() && store::ToTime(token.expire_time()) <= now;
  return token.admin() && !token.has_revoke_time() && !expired;
}

// Whether nobody but this token may make another.
absl::StatusOr<bool> IsLastAdmin(Transaction& transaction, const std::string& name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto tokens, store::AllTokens(transaction));
  bool is_last = false;
  for (const store::StoredToken& stored : tokens) {
    if (!MakesTokens(stored.token, transaction.now())) continue;
    if (stored.token.name() != name) return false;
    is_last = true;
  }
  return is_last;
}

absl::StatusOr<v1::Token> Revoke(Transaction& transaction, const std::string& name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const bool is_last, IsLastAdmin(transaction, name));
  if (!is_last) return store::RevokeToken(transaction, name);
  return store::Refusal(absl::StatusCode::kFailedPrecondition, "name",
                        absl::StrCat(name, ", the last token of an admin"),
                        "one beside another admin's; create that before");
}

}  // namespace

absl::StatusOr<v1::CreateTokenResponse> Bootstrap(const CallContext& call,
                                                  const v1::BootstrapRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(CheckAsksForTokens(call));
  FaultList faults;
  CheckPrincipal(request.principal(), "principal", faults);
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  v1::Token token;
  token.set_principal(request.principal());
  token.set_kind(v1::PERSON);
  token.set_admin(true);
  token.set_created_by(kBootstrap);
  absl::StatusOr<v1::CreateTokenResponse> response;
  TRUEPOSE_RETURN_IF_ERROR(call.administration->bootstrap.Use(request.secret(), [&] {
    response = Make(call, {}, token);
    return response.status();
  }));
  return response;
}

absl::StatusOr<v1::CreateTokenResponse> CreateToken(const CallContext& call,
                                                    const v1::CreateTokenRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(CheckAsksForTokens(call));
  TRUEPOSE_RETURN_IF_ERROR(CheckContent(request.token(), call.store.clock().Now()));
  v1::Token token = request.token();
  token.clear_revoke_time();
  token.set_created_by(call.caller.principal);
  return Make(call, resource::KeyOf(call.caller.principal, request, request.request_id()), token);
}

absl::StatusOr<v1::ListTokensResponse> ListTokens(const CallContext& call,
                                                  const v1::ListTokensRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(store::Page<v1::Token> page, call.store.Read([&](Snapshot& snapshot) {
    return store::ListTokens(snapshot, PageOf(request));
  }));
  return ToResponse(std::move(page), &v1::ListTokensResponse::mutable_tokens);
}

absl::StatusOr<v1::Token> RevokeToken(const CallContext& call,
                                      const v1::RevokeTokenRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Token token, call.store.Write([&](Transaction& transaction) {
    return Revoke(transaction, request.name());
  }));
  call.administration->authenticator.Learn({.token = token, .secret_sha256 = ""});
  return token;
}

absl::StatusOr<v1::ServerStatus> GetServerStatus(const CallContext& call,
                                                 const v1::GetServerStatusRequest&) {
  TRUEPOSE_ASSIGN_OR_RETURN(const store::Tally tally, call.store.Read([](Snapshot& snapshot) {
    return store::CountAll(snapshot);
  }));
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t revision, call.store.Revision());
  v1::ServerStatus status;
  FillTally(tally, status);
  FillFacts(*call.administration, status);
  status.set_epoch(call.store.epoch());
  status.set_revision(revision);
  *status.mutable_server_time() = store::ToTimestamp(call.store.clock().Now());
  status.set_principal(call.caller.principal);
  status.set_admin(call.caller.is_admin);
  status.set_principal_kind(call.caller.is_machine ? v1::MACHINE : v1::PERSON);
  return status;
}

}  // namespace truepose::services
