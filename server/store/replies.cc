#include "server/store/replies.h"

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/sql/query.h"

namespace truepose::store {

absl::StatusOr<std::optional<std::string>> FindReply(Snapshot& snapshot, const RequestKey& key) {
  TRUEPOSE_RETURN_IF_ERROR(CheckUuid(key.request_id, "request_id"));
  TRUEPOSE_ASSIGN_OR_RETURN(auto row,
                            sql::Query(snapshot.sql(),
                                       "SELECT digest, reply FROM replies WHERE principal = $1 AND "
                                       "method = $2 AND request_id = $3",
                                       key.principal, key.method, key.request_id));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  if (!found) return std::optional<std::string>();
  if (row->Text(0) == key.digest) return std::optional<std::string>(row->Blob(1));
  return Refusal(absl::StatusCode::kInvalidArgument, "request_id",
                 absl::StrCat(key.request_id, ", which came with another content before"),
                 "a new UUID for each request, the same only for a repeat of it");
}

absl::Status KeepReply(Transaction& transaction, const RequestKey& key, std::string_view reply) {
  return sql::Run(transaction.sql(),
                  "INSERT INTO replies (principal, method, request_id, digest, written_us, reply) "
                  "VALUES ($1, $2, $3, $4, $5, $6)",
                  key.principal, key.method, key.request_id, key.digest,
                  absl::ToUnixMicros(transaction.now()), sql::BlobView{reply});
}

absl::StatusOr<bool> HasRepliesToForget(Snapshot& snapshot, absl::Time now) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      const int64_t count,
      sql::QueryInt64(snapshot.sql(),
                      "SELECT COUNT(*) FROM (SELECT 1 FROM replies WHERE written_us < $1 LIMIT 1) "
                      "AS old",
                      absl::ToUnixMicros(now - kKeepReplies)));
  return count > 0;
}

absl::StatusOr<int64_t> ForgetReplies(Transaction& transaction, int64_t most) {
  const int64_t oldest = absl::ToUnixMicros(transaction.now() - kKeepReplies);
  TRUEPOSE_ASSIGN_OR_RETURN(
      const int64_t count,
      sql::QueryInt64(transaction.sql(),
                      "SELECT COUNT(*) FROM (SELECT 1 FROM replies WHERE written_us < $1 LIMIT $2)",
                      oldest, most));
  if (count == 0) return 0;
  TRUEPOSE_RETURN_IF_ERROR(sql::Run(
      transaction.sql(),
      "DELETE FROM replies WHERE (principal, method, request_id) IN (SELECT principal, method, "
      "request_id FROM replies WHERE written_us < $1 ORDER BY written_us LIMIT $2)",
      oldest, most));
  return count;
}

}  // namespace truepose::store
