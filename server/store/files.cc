#include "server/store/files.h"

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/store/message.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

constexpr int64_t kNone = 0;

absl::StatusOr<int64_t> FileKey(Snapshot& snapshot, std::string_view sha256) {
  return sql::QueryInt64(
      snapshot.sql(), "SELECT COALESCE((SELECT sequence FROM files WHERE sha256 = $1), 0)", sha256);
}

}  // namespace

absl::Status PutFile(Transaction& transaction, std::string_view sha256, std::string_view bytes) {
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t there, FileKey(transaction, sha256));
  if (there != kNone) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(
      const int64_t file,
      sql::QueryInt64(transaction.sql(),
                      "INSERT INTO files (sequence, sha256, size_bytes) VALUES ((SELECT "
                      "COALESCE(MAX(sequence), 0) + 1 FROM files), $1, $2) RETURNING sequence",
                      sha256, bytes.size()));
  for (size_t begin = 0; begin < bytes.size(); begin += kPieceBytes) {
    TRUEPOSE_RETURN_IF_ERROR(sql::Run(
        transaction.sql(), "INSERT INTO file_pieces (file, position, bytes) VALUES ($1, $2, $3)",
        file, begin / kPieceBytes, sql::BlobView{bytes.substr(begin, kPieceBytes)}));
  }
  return absl::OkStatus();
}

absl::StatusOr<std::string> ReadPiece(Snapshot& snapshot, std::string_view sha256,
                                      int64_t position) {
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t file, FileKey(snapshot, sha256));
  if (file == kNone) return NotFound(sha256, "sha256");
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row,
      sql::Query(snapshot.sql(), "SELECT bytes FROM file_pieces WHERE file = $1 AND position = $2",
                 file, position));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  return found ? row->Blob(0) : std::string();
}

absl::StatusOr<bool> HasFile(Snapshot& snapshot, std::string_view sha256) {
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t file, FileKey(snapshot, sha256));
  return file != kNone;
}

absl::Status DropFile(Transaction& transaction, std::string_view sha256) {
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t file, FileKey(transaction, sha256));
  TRUEPOSE_RETURN_IF_ERROR(
      sql::Run(transaction.sql(), "DELETE FROM file_pieces WHERE file = $1", file));
  return sql::Run(transaction.sql(), "DELETE FROM files WHERE sequence = $1", file);
}

}  // namespace truepose::store
