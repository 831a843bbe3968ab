// Only for sqlite.cc: statements and error codes of SQLite.
#pragma once

#include <sqlite3.h>

#include <memory>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/sql/connection.h"

namespace truepose::store::sql {

// The status of a result code that isn't SQLITE_OK; `database` gives the message.
absl::Status SqliteStatus(int code, sqlite3* database);

class SqliteStatement : public Statement {
 public:
  static absl::StatusOr<std::unique_ptr<Statement>> Prepare(sqlite3* database,
                                                            std::string_view sql);
  ~SqliteStatement() override;

  void BindInt64(int index, int64_t value) override;
  void BindDouble(int index, double value) override;
  void BindText(int index, std::string_view value) override;
  void BindBlob(int index, std::string_view value) override;
  absl::StatusOr<bool> Step() override;
  void Reset() override;
  int64_t Int64(int column) const override;
  double Double(int column) const override;
  std::string Text(int column) const override;
  std::string Blob(int column) const override;

 private:
  SqliteStatement(sqlite3* database, sqlite3_stmt* statement)
      : database_(database), statement_(statement) {}
  // SQLite numbers $1, $2, ... in the order in which they appear, not by their digits.
  int Position(int index) const;
  void Keep(int code);

  sqlite3* database_;
  sqlite3_stmt* statement_;
  int bind_code_ = SQLITE_OK;  // the first failure of a bind, told by Step()
};

}  // namespace truepose::store::sql
