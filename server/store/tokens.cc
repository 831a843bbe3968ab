#include "server/store/tokens.h"

#include <limits>
#include <utility>

#include "core/base/status_macros.h"
#include "server/store/list.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

absl::StatusOr<v1::Token> GetToken(Snapshot& snapshot, const std::string& id) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row, sql::Query(snapshot.sql(), "SELECT message FROM tokens WHERE id = $1", id));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  if (!found) return NotFound(TokenName(id));
  return ReadMessage<v1::Token>(*row, 0);
}

absl::StatusOr<StoredToken> ReadStoredToken(const sql::Statement& row) {
  StoredToken stored;
  TRUEPOSE_ASSIGN_OR_RETURN(stored.token, ReadMessage<v1::Token>(row, 0));
  stored.secret_sha256 = row.Text(1);
  if (row.Int64(2) != 0) stored.last_use = absl::FromUnixMicros(row.Int64(2));
  return stored;
}

}  // namespace

absl::StatusOr<v1::Token> InsertToken(Transaction& transaction, const std::string& id,
                                      const std::string& secret_sha256, v1::Token token) {
  TRUEPOSE_RETURN_IF_ERROR(CheckUuid(id, "token_id"));
  token.set_name(TokenName(id));
  *token.mutable_create_time() = ToTimestamp(transaction.now());
  TRUEPOSE_RETURN_IF_ERROR(
      sql::Run(transaction.sql(),
               "INSERT INTO tokens (sequence, id, principal, secret_sha256, message) VALUES "
               "((SELECT COALESCE(MAX(sequence), 0) + 1 FROM tokens), $1, $2, $3, $4)",
               id, token.principal(), secret_sha256, sql::BlobView{ToBlob(token)}));
  return token;
}

absl::StatusOr<std::optional<v1::Token>> ReplaceUnusedSecret(Transaction& transaction,
                                                             std::string_view name,
                                                             const std::string& secret_sha256) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string id, ParseTokenName(name));
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Token token, GetToken(transaction, id));
  TRUEPOSE_ASSIGN_OR_RETURN(
      const int64_t last_use,
      sql::QueryInt64(transaction.sql(), "SELECT last_use FROM tokens WHERE id = $1", id));
  if (last_use != 0 || token.has_revoke_time()) return std::optional<v1::Token>();
  TRUEPOSE_RETURN_IF_ERROR(sql::Run(
      transaction.sql(), "UPDATE tokens SET secret_sha256 = $2 WHERE id = $1", id, secret_sha256));
  return std::optional(std::move(token));
}

absl::StatusOr<v1::Token> RevokeToken(Transaction& transaction, std::string_view name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string id, ParseTokenName(name));
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Token token, GetToken(transaction, id));
  if (token.has_revoke_time()) return token;
  *token.mutable_revoke_time() = ToTimestamp(transaction.now());
  TRUEPOSE_RETURN_IF_ERROR(sql::Run(transaction.sql(),
                                    "UPDATE tokens SET message = $2 WHERE id = $1", id,
                                    sql::BlobView{ToBlob(token)}));
  return token;
}

absl::Status RecordTokenUse(Transaction& transaction, std::string_view name, absl::Time time) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string id, ParseTokenName(name));
  return sql::Run(transaction.sql(), "UPDATE tokens SET last_use = $2 WHERE id = $1", id,
                  absl::ToUnixMicros(time));
}

absl::StatusOr<Page<v1::Token>> ListTokens(Snapshot& snapshot, const PageRequest& request) {
  const ListId id{"tokens", ""};
  TRUEPOSE_ASSIGN_OR_RETURN(const PageStart start, CheckPage(id, request));
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t before,
                            AfterNumber(start, std::numeric_limits<int64_t>::max()));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows, sql::Query(snapshot.sql(),
                            "SELECT sequence, message, last_use FROM tokens WHERE sequence < $1 "
                            "ORDER BY sequence DESC LIMIT $2",
                            before, start.size + 1));
  return ReadPage<v1::Token>(
      id, start.size, *rows, [](const sql::Statement& row) -> absl::StatusOr<v1::Token> {
        TRUEPOSE_ASSIGN_OR_RETURN(v1::Token token, ReadMessage<v1::Token>(row, 1));
        const int64_t last_use_us = row.Int64(2);
        if (last_use_us > 0)
          *token.mutable_last_use_time() = ToTimestamp(absl::FromUnixMicros(last_use_us));
        return token;
      });
}

absl::StatusOr<std::vector<StoredToken>> AllTokens(Snapshot& snapshot) {
  std::vector<StoredToken> all;
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows,
      sql::Query(snapshot.sql(),
                 "SELECT message, secret_sha256, last_use FROM tokens ORDER BY sequence"));
  for (;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, rows->Step());
    if (!found) return all;
    TRUEPOSE_ASSIGN_OR_RETURN(StoredToken stored, ReadStoredToken(*rows));
    all.push_back(std::move(stored));
  }
}

absl::StatusOr<v1::PrincipalKind> KindOfPrincipal(Snapshot& snapshot,
                                                  const std::string& principal) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row, sql::Query(snapshot.sql(),
                           "SELECT message FROM tokens WHERE principal = $1 ORDER BY sequence "
                           "LIMIT 1",
                           principal));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  if (!found) return v1::PRINCIPAL_KIND_UNSPECIFIED;
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Token token, ReadMessage<v1::Token>(*row, 0));
  return token.kind();
}

}  // namespace truepose::store
