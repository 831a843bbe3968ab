// Only for sqlite.cc: statements, kept between their uses, and error codes of SQLite.
#pragma once

#include <sqlite3.h>

#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/sql/connection.h"

namespace truepose::store::sql {

// The status of a result code that isn't SQLITE_OK; `database` gives the message.
absl::Status SqliteStatus(int code, sqlite3* database);

// The statements of one connection that nobody uses at the moment, by their text: to compile one
// takes longer than most take to run. Outlives every statement that it made.
class StatementCache {
 public:
  explicit StatementCache(sqlite3* database) : database_(database) {}
  StatementCache(const StatementCache&) = delete;
  StatementCache& operator=(const StatementCache&) = delete;
  // Finalizes what it keeps.
  ~StatementCache() { Clear(); }

  absl::StatusOr<std::unique_ptr<Statement>> Prepare(std::string_view sql);
  // Before the connection is closed.
  void Clear();

 private:
  friend class SqliteStatement;

  struct Compiled {
    sqlite3_stmt* statement = nullptr;
    // SQLite numbers $1, $2, ... in the order in which they appear, not by their digits:
    // positions[k] is SQLite's number of $k, 0 when there is none.
    std::vector<int> positions;
  };
  struct Hash {
    using is_transparent = void;
    size_t operator()(std::string_view text) const { return std::hash<std::string_view>()(text); }
  };
  using Idle = std::unordered_map<std::string, Compiled, Hash, std::equal_to<>>;

  absl::StatusOr<Idle::node_type> Compile(std::string_view sql);
  void GiveBack(Idle::node_type node);

  sqlite3* database_;
  Idle idle_;
};

class SqliteStatement : public Statement {
 public:
  SqliteStatement(StatementCache& cache, StatementCache::Idle::node_type node)
      : cache_(cache), node_(std::move(node)), statement_(node_.mapped().statement) {}
  ~SqliteStatement() override { cache_.GiveBack(std::move(node_)); }

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
  int Position(int index) const;
  void Keep(int code);

  StatementCache& cache_;
  StatementCache::Idle::node_type node_;
  sqlite3_stmt* statement_;
  int bind_code_ = SQLITE_OK;  // the first failure of a bind, told by Step()
};

}  // namespace truepose::store::sql
