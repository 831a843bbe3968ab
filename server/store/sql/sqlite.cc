#include "server/store/sql/sqlite.h"

#include <sqlite3.h>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/store/sql/query.h"
#include "server/store/sql/sqlite_statement.h"

namespace truepose::store::sql {
namespace {

// "TPOS", in the file's header: tells our databases from those of other programs.
constexpr int kApplicationId = 0x54504f53;

class SqliteConnection : public Connection {
 public:
  explicit SqliteConnection(sqlite3* database) : database_(database), statements_(database) {}
  ~SqliteConnection() override {
    statements_.Clear();
    sqlite3_close_v2(database_);
  }

  absl::StatusOr<std::unique_ptr<Statement>> Prepare(std::string_view sql) override {
    return statements_.Prepare(sql);
  }
  absl::Status Execute(std::string_view sql) override {
    const int code = sqlite3_exec(database_, std::string(sql).c_str(), nullptr, nullptr, nullptr);
    return code == SQLITE_OK ? absl::OkStatus() : SqliteStatus(code, database_);
  }
  absl::Status Begin(Access access) override {
    return Run(*this, access == Access::kWrite ? "BEGIN IMMEDIATE" : "BEGIN");
  }
  absl::StatusOr<int64_t> SchemaVersion() override {
    return QueryInt64(*this, "PRAGMA user_version");
  }
  absl::Status SetSchemaVersion(int64_t version) override {
    return Execute(absl::StrCat("PRAGMA user_version = ", version));
  }

  bool IsReadOnly() const { return sqlite3_db_readonly(database_, "main") == 1; }

 private:
  sqlite3* database_;
  StatementCache statements_;
};

absl::Status OpenFault(const std::string& path, std::string found, std::string expected) {
  FaultList faults;
  faults.Add(path, std::move(found), std::move(expected));
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

// The first look into the file; nothing is changed before it.
absl::Status CheckOwner(SqliteConnection& connection, const std::string& path) {
  const absl::StatusOr<int64_t> tables =
      QueryInt64(connection, "SELECT COUNT(*) FROM sqlite_master");
  if (absl::IsDataLoss(tables.status())) {
    return OpenFault(
        path, absl::StrCat("a file that SQLite can't read (", tables.status().message(), ")"),
        "a Truepose database");
  }
  TRUEPOSE_RETURN_IF_ERROR(tables.status());
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t id, QueryInt64(connection, "PRAGMA application_id"));
  if (id != kApplicationId && *tables > 0) {
    return OpenFault(path, "an SQLite database of another program", "a Truepose database");
  }
  if (connection.IsReadOnly())
    return OpenFault(path, "a read-only database", "one that can be written");
  return absl::OkStatus();
}

// The one place with settings. FULL: an acknowledged commit survives a power loss, NORMAL would
// lose it.
absl::Status Configure(SqliteConnection& connection, Access access) {
  TRUEPOSE_RETURN_IF_ERROR(
      connection.Execute("PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON"));
  if (access == Access::kRead) return connection.Execute("PRAGMA query_only = ON");
  TRUEPOSE_RETURN_IF_ERROR(connection.Execute("PRAGMA journal_mode = WAL"));
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t id, QueryInt64(connection, "PRAGMA application_id"));
  // Only once: even the same mark written again would change a file that is refused later.
  if (id == kApplicationId) return absl::OkStatus();
  return connection.Execute(absl::StrCat("PRAGMA application_id = ", kApplicationId));
}

}  // namespace

absl::StatusOr<std::unique_ptr<Connection>> OpenSqlite(const std::string& path, Access access) {
  sqlite3* database = nullptr;
  const int create = access == Access::kWrite ? SQLITE_OPEN_CREATE : 0;
  const int code = sqlite3_open_v2(path.c_str(), &database,
                                   SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX | create, nullptr);
  auto connection = std::make_unique<SqliteConnection>(database);
  if (code != SQLITE_OK) {
    return OpenFault(path,
                     absl::StrCat("a file that can't be opened (", sqlite3_errmsg(database), ")"),
                     "a Truepose database or a new file");
  }
  sqlite3_extended_result_codes(database, 1);
  // A backup or a person's shell may hold the file for a moment.
  sqlite3_busy_timeout(database, 5000);
  if (access == Access::kWrite) TRUEPOSE_RETURN_IF_ERROR(CheckOwner(*connection, path));
  TRUEPOSE_RETURN_IF_ERROR(Configure(*connection, access));
  return connection;
}

}  // namespace truepose::store::sql
