// Tokens: who may call. Of a secret only its hash is here (server/auth/secret.h).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/store/page.h"
#include "server/store/transaction.h"
#include "truepose/v1/admin.pb.h"

namespace truepose::store {

struct StoredToken {
  v1::Token token;
  std::string secret_sha256;                   // lower-case hex
  absl::Time last_use = absl::InfinitePast();  // as it was recorded, at most an hour old
};

// Fills in name (of `id`, a UUID) and create_time. @returns kAlreadyExists for an id or a secret
// that is there.
absl::StatusOr<v1::Token> InsertToken(Transaction& transaction, const std::string& id,
                                      const std::string& secret_sha256, v1::Token token);

// Another secret for a token that was never used and is not revoked; nothing for any other.
// @returns kInvalidArgument for a malformed name, kNotFound; kAlreadyExists for a secret that is
// there.
absl::StatusOr<std::optional<v1::Token>> ReplaceUnusedSecret(Transaction& transaction,
                                                             std::string_view name,
                                                             const std::string& secret_sha256);

// Sets revoke_time; a revoked one stays as it is.
// @returns kInvalidArgument for a malformed name, kNotFound.
absl::StatusOr<v1::Token> RevokeToken(Transaction& transaction, std::string_view name);

// Nothing of the token's message changes by it.
absl::Status RecordTokenUse(Transaction& transaction, std::string_view name, absl::Time time);

// Newest first, revoked and expired ones too.
absl::StatusOr<Page<v1::Token>> ListTokens(Snapshot& snapshot, const PageRequest& request);
absl::StatusOr<std::vector<StoredToken>> AllTokens(Snapshot& snapshot);

// That of the principal's tokens, revoked ones too; PRINCIPAL_KIND_UNSPECIFIED when there is none.
absl::StatusOr<v1::PrincipalKind> KindOfPrincipal(Snapshot& snapshot, const std::string& principal);

}  // namespace truepose::store
