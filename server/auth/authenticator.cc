#include "server/auth/authenticator.h"

#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/auth/secret.h"
#include "server/store/message.h"

namespace truepose::auth {
namespace {

constexpr absl::string_view kScheme = "Bearer ";
constexpr char kGoOn[] =
    "`authorization: Bearer SECRET` with the secret of a token that holds; an admin makes one with "
    "`truepose token create`";

absl::Status Unauthenticated(std::string found) {
  return store::Refusal(absl::StatusCode::kUnauthenticated, "authorization", std::move(found),
                        kGoOn);
}

absl::Time ToTime(const google::protobuf::Timestamp& time) {
  return absl::FromUnixSeconds(time.seconds()) + absl::Nanoseconds(time.nanos());
}

std::string At(const google::protobuf::Timestamp& time) {
  return absl::FormatTime("%Y-%m-%d %H:%M:%SZ", ToTime(time), absl::UTCTimeZone());
}

Caller ToCaller(const v1::Token& token) {
  return {.principal = token.principal(),
          .is_machine = token.kind() != v1::PERSON,
          .is_admin = token.admin(),
          .is_local_dev = false,
          .token = token.name()};
}

}  // namespace

std::unique_ptr<Authenticator> Authenticator::OpenToAll() {
  return std::unique_ptr<Authenticator>(new Authenticator(nullptr));
}

absl::StatusOr<std::unique_ptr<Authenticator>> Authenticator::Load(store::Store& store) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      const std::vector<store::StoredToken> tokens,
      store.Read([](store::Snapshot& snapshot) { return store::AllTokens(snapshot); }));
  std::unique_ptr<Authenticator> authenticator(new Authenticator(&store));
  for (const store::StoredToken& token : tokens) authenticator->Learn(token);
  return authenticator;
}

absl::StatusOr<Caller> Authenticator::Authenticate(std::string_view authorization) {
  if (is_open_to_all()) return Caller();
  const absl::string_view shown(authorization.data(), authorization.size());
  if (shown.empty()) return Unauthenticated("no token");
  if (!absl::StartsWithIgnoreCase(shown, kScheme)) return Unauthenticated("another scheme");
  const std::string hash = HashOf(authorization.substr(kScheme.size()));
  const std::lock_guard lock(mutex_);
  const auto name = names_of_hash_.find(hash);
  if (name == names_of_hash_.end()) return Unauthenticated("a secret of no token of this server");
  store::StoredToken& stored = tokens_.at(name->second);
  TRUEPOSE_RETURN_IF_ERROR(CheckHolds(stored.token));
  RecordUse(stored);
  return ToCaller(stored.token);
}

absl::Status Authenticator::Recheck(const Caller& caller) const {
  if (is_open_to_all()) return absl::OkStatus();
  const std::lock_guard lock(mutex_);
  const auto stored = tokens_.find(caller.token);
  if (stored == tokens_.end()) return Unauthenticated("no token");
  return CheckHolds(stored->second.token);
}

absl::Status Authenticator::CheckHolds(const v1::Token& token) const {
  if (token.has_revoke_time()) {
    return Unauthenticated(
        absl::StrCat(token.name(), ", which was revoked at ", At(token.revoke_time())));
  }
  if (token.has_expire_time() && ToTime(token.expire_time()) <= store_->clock().Now()) {
    return Unauthenticated(
        absl::StrCat(token.name(), ", which expired at ", At(token.expire_time())));
  }
  return absl::OkStatus();
}

// Nobody waits for it, and one that is lost is made up for by the next.
void Authenticator::RecordUse(store::StoredToken& stored) {
  const absl::Time now = store_->clock().Now();
  if (now - stored.last_use < kUseResolution) return;
  stored.last_use = now;
  store_->WriteAsync(
      [name = stored.token.name(), now](store::Transaction& transaction) {
        return store::RecordTokenUse(transaction, name, now);
      },
      [](const absl::Status&) {});
}

void Authenticator::Learn(const store::StoredToken& token) {
  const std::lock_guard lock(mutex_);
  const auto [known, is_new] = tokens_.emplace(token.token.name(), token);
  if (!token.secret_sha256.empty()) LearnSecret(token.secret_sha256, known->second);
  if (!is_new && token.token.has_revoke_time()) known->second.token = token.token;
}

void Authenticator::LearnSecret(const std::string& secret_sha256, store::StoredToken& token) {
  names_of_hash_.erase(token.secret_sha256);
  token.secret_sha256 = secret_sha256;
  names_of_hash_.emplace(secret_sha256, token.token.name());
}

bool Authenticator::HasAdmin() const {
  const std::lock_guard lock(mutex_);
  for (const auto& [name, stored] : tokens_) {
    if (stored.token.admin() && CheckHolds(stored.token).ok()) return true;
  }
  return false;
}

}  // namespace truepose::auth
