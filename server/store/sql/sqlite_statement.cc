#include "server/store/sql/sqlite_statement.h"

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"

namespace truepose::store::sql {
namespace {

absl::StatusCode CodeOf(int code, int extended) {
  if (extended == SQLITE_CONSTRAINT_UNIQUE || extended == SQLITE_CONSTRAINT_PRIMARYKEY) {
    return absl::StatusCode::kAlreadyExists;
  }
  switch (code) {
    case SQLITE_CONSTRAINT:
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
      return absl::StatusCode::kFailedPrecondition;
    case SQLITE_FULL:
    case SQLITE_NOMEM:
    case SQLITE_TOOBIG:
      return absl::StatusCode::kResourceExhausted;
    case SQLITE_IOERR:
      return absl::StatusCode::kUnavailable;
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return absl::StatusCode::kDataLoss;
    default:
      return absl::StatusCode::kInternal;
  }
}

// Reads go on; clients may send the same again.
constexpr char kFull[] =
    "database: the disk is full; nothing of this was stored. Free space where the database is, "
    "then "
    "send it again";

// More than the texts of all repositories together.
constexpr size_t kMostIdle = 500;

// Some of these act when they are compiled, not when they run.
bool IsPragma(std::string_view sql) { return sql.starts_with("PRAGMA"); }

}  // namespace

absl::Status SqliteStatus(int code, sqlite3* database) {
  const int primary = code & 0xff;
  const std::string message = absl::StrCat("database: ", sqlite3_errmsg(database));
  if (primary == SQLITE_BUSY || primary == SQLITE_LOCKED) return Retryable(message);
  if (primary == SQLITE_FULL) return absl::ResourceExhaustedError(kFull);
  return absl::Status(CodeOf(primary, sqlite3_extended_errcode(database)), message);
}

absl::StatusOr<std::unique_ptr<Statement>> StatementCache::Prepare(std::string_view sql) {
  const auto found = idle_.find(sql);
  if (found != idle_.end()) return std::make_unique<SqliteStatement>(*this, idle_.extract(found));
  TRUEPOSE_ASSIGN_OR_RETURN(Idle::node_type node, Compile(sql));
  return std::make_unique<SqliteStatement>(*this, std::move(node));
}

absl::StatusOr<StatementCache::Idle::node_type> StatementCache::Compile(std::string_view sql) {
  Compiled compiled;
  const int code = sqlite3_prepare_v2(database_, sql.data(), static_cast<int>(sql.size()),
                                      &compiled.statement, nullptr);
  if (code != SQLITE_OK) return SqliteStatus(code, database_);
  const int parameters = sqlite3_bind_parameter_count(compiled.statement);
  compiled.positions.push_back(0);
  for (int i = 1; i <= parameters; ++i) {
    const std::string name = absl::StrCat("$", i);
    compiled.positions.push_back(sqlite3_bind_parameter_index(compiled.statement, name.c_str()));
  }
  Idle one;
  return one.extract(one.emplace(std::string(sql), std::move(compiled)).first);
}

void StatementCache::GiveBack(Idle::node_type node) {
  sqlite3_stmt* statement = node.mapped().statement;
  sqlite3_reset(statement);
  sqlite3_clear_bindings(statement);
  const bool keep = idle_.size() < kMostIdle && !IsPragma(node.key());
  if (!keep || !idle_.insert(std::move(node)).inserted) sqlite3_finalize(statement);
}

void StatementCache::Clear() {
  for (const auto& [sql, compiled] : idle_) sqlite3_finalize(compiled.statement);
  idle_.clear();
}

int SqliteStatement::Position(int index) const {
  const std::vector<int>& positions = node_.mapped().positions;
  return index > 0 && index < static_cast<int>(positions.size()) ? positions[index] : 0;
}

void SqliteStatement::Keep(int code) {
  if (bind_code_ == SQLITE_OK) bind_code_ = code;
}

void SqliteStatement::BindInt64(int index, int64_t value) {
  Keep(sqlite3_bind_int64(statement_, Position(index), value));
}

void SqliteStatement::BindDouble(int index, double value) {
  Keep(sqlite3_bind_double(statement_, Position(index), value));
}

void SqliteStatement::BindText(int index, std::string_view value) {
  Keep(sqlite3_bind_text64(statement_, Position(index), value.empty() ? "" : value.data(),
                           value.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
}

void SqliteStatement::BindBlob(int index, std::string_view value) {
  // A null pointer would bind NULL; an empty message is an empty blob.
  Keep(sqlite3_bind_blob64(statement_, Position(index), value.empty() ? "" : value.data(),
                           value.size(), SQLITE_TRANSIENT));
}

absl::StatusOr<bool> SqliteStatement::Step() {
  if (bind_code_ != SQLITE_OK) {
    return absl::InternalError(absl::StrCat("database: can't bind: ", sqlite3_errstr(bind_code_)));
  }
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  return SqliteStatus(code, sqlite3_db_handle(statement_));
}

void SqliteStatement::Reset() { sqlite3_reset(statement_); }

int64_t SqliteStatement::Int64(int column) const {
  return sqlite3_column_int64(statement_, column);
}

double SqliteStatement::Double(int column) const {
  return sqlite3_column_double(statement_, column);
}

std::string SqliteStatement::Text(int column) const { return Blob(column); }

std::string SqliteStatement::Blob(int column) const {
  const void* bytes = sqlite3_column_blob(statement_, column);
  const size_t size = static_cast<size_t>(sqlite3_column_bytes(statement_, column));
  return bytes == nullptr ? std::string() : std::string(static_cast<const char*>(bytes), size);
}

}  // namespace truepose::store::sql
