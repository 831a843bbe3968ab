// The seam, on SQLite.
#include <gtest/gtest.h>

#include <string>

#include "server/store/sql/query.h"
#include "server/store/sql/sqlite.h"
#include "server/store/sql/transaction.h"
#include "tests/store/testing/temporary_folder.h"

namespace truepose::store::sql {
namespace {

class Sql : public ::testing::Test {
 protected:
  void SetUp() override {
    auto opened = OpenSqlite(":memory:", Access::kWrite);
    ASSERT_TRUE(opened.ok()) << opened.status();
    connection_ = *std::move(opened);
    ASSERT_TRUE(
        connection_
            ->Execute("CREATE TABLE t (id INTEGER PRIMARY KEY, x REAL, s TEXT, b BLOB) STRICT")
            .ok());
  }
  int64_t Count() { return *QueryInt64(*connection_, "SELECT COUNT(*) FROM t"); }

  std::unique_ptr<Connection> connection_;
};

// Catches values that change on their way: 64 bits, fractions, text with other letters, bytes with
// zeros, emptiness.
TEST_F(Sql, EveryTypeComesBack) {
  const std::string bytes("\0\xff\n", 3);
  ASSERT_TRUE(sql::Run(*connection_, "INSERT INTO t VALUES ($1, $2, $3, $4)", int64_t{1} << 62, 0.1,
                       std::string("Käfig"), BlobView{bytes})
                  .ok());
  auto row = Query(*connection_, "SELECT id, x, s, b FROM t");
  ASSERT_TRUE(*(*row)->Step());
  EXPECT_EQ((*row)->Int64(0), int64_t{1} << 62);
  EXPECT_EQ((*row)->Double(1), 0.1);
  EXPECT_EQ((*row)->Text(2), "Käfig");
  EXPECT_EQ((*row)->Blob(3), bytes);
  EXPECT_FALSE(*(*row)->Step());
  ASSERT_TRUE(
      sql::Run(*connection_, "INSERT INTO t VALUES (1, 0, $1, $2)", std::string(), BlobView{})
          .ok());
  EXPECT_EQ(*QueryInt64(*connection_, "SELECT COUNT(*) FROM t WHERE s = '' AND b = x''"), 1)
      << "not NULL";
}

// Catches parameters that are numbered in the order of their appearance.
TEST_F(Sql, ParametersGoByTheirDigits) {
  EXPECT_EQ(*QueryInt64(*connection_, "SELECT $2 - $1", 1, 10), 9);
  EXPECT_EQ(sql::Run(*connection_, "SELECT $1", 1, 2).code(), absl::StatusCode::kInternal)
      << "one too many";
}

// Catches statements that are kept between their uses with what they were given, one that is in use
// twice, and one that holds a row after its user has gone.
TEST_F(Sql, AStatementIsUsedAgainAsNew) {
  constexpr char kInsert[] = "INSERT INTO t (id, s) VALUES ($1, $2)";
  ASSERT_TRUE(sql::Run(*connection_, kInsert, 1, std::string("one")).ok());
  {
    auto unbound = connection_->Prepare(kInsert);
    (*unbound)->BindInt64(1, 2);
    ASSERT_TRUE((*unbound)->Step().ok());
  }
  EXPECT_EQ(*QueryInt64(*connection_, "SELECT COUNT(*) FROM t WHERE s IS NULL"), 1);
  {
    auto outer = Query(*connection_, "SELECT id FROM t ORDER BY id");
    auto inner = Query(*connection_, "SELECT id FROM t ORDER BY id");
    ASSERT_TRUE(*(*outer)->Step());
    ASSERT_TRUE(*(*inner)->Step());
    ASSERT_TRUE(*(*inner)->Step());
    EXPECT_EQ((*outer)->Int64(0), 1);
    EXPECT_EQ((*inner)->Int64(0), 2);
  }
  EXPECT_TRUE(connection_->Execute("DROP TABLE t").ok()) << "a reader was left in the middle";
  ASSERT_TRUE(connection_->Execute("CREATE TABLE t (id INTEGER, s TEXT)").ok());
  EXPECT_TRUE(sql::Run(*connection_, kInsert, 1, std::string("new table")).ok());
}

// Catches codes that callers can't act on.
TEST_F(Sql, ErrorsHaveTheirCodes) {
  ASSERT_TRUE(connection_->Execute("INSERT INTO t (id) VALUES (1)").ok());
  EXPECT_EQ(connection_->Execute("INSERT INTO t (id) VALUES (1)").code(),
            absl::StatusCode::kAlreadyExists);
  EXPECT_EQ(connection_->Execute("INSERT INTO t (id, x) VALUES (2, 'text')").code(),
            absl::StatusCode::kFailedPrecondition)
      << "STRICT";
  EXPECT_EQ(connection_->Execute("INSERT INTO nowhere VALUES (1)").code(),
            absl::StatusCode::kInternal);
  ASSERT_TRUE(connection_->Execute("CREATE TABLE child (t INTEGER REFERENCES t (id)) STRICT").ok());
  EXPECT_EQ(connection_->Execute("INSERT INTO child VALUES (9)").code(),
            absl::StatusCode::kFailedPrecondition)
      << "foreign keys";
}

// Catches a transaction that commits by itself.
TEST_F(Sql, ATransactionRollsBackUnlessItIsCommitted) {
  {
    auto transaction = Transaction::Begin(*connection_, Access::kWrite);
    ASSERT_TRUE(transaction.ok());
    ASSERT_TRUE(connection_->Execute("INSERT INTO t (id) VALUES (1)").ok());
  }
  EXPECT_EQ(Count(), 0);
  auto transaction = Transaction::Begin(*connection_, Access::kWrite);
  ASSERT_TRUE(connection_->Execute("INSERT INTO t (id) VALUES (1)").ok());
  ASSERT_TRUE(transaction->Commit().ok());
  EXPECT_EQ(Count(), 1);
}

// Catches a savepoint that undoes too much, too little, or stays open.
TEST_F(Sql, ASavepointUndoesItsPartAlone) {
  auto transaction = Transaction::Begin(*connection_, Access::kWrite);
  ASSERT_TRUE(connection_->Execute("INSERT INTO t (id) VALUES (1)").ok());
  {
    auto dropped = Savepoint::Begin(*connection_);
    ASSERT_TRUE(connection_->Execute("INSERT INTO t (id) VALUES (2)").ok());
  }
  auto kept = Savepoint::Begin(*connection_);
  ASSERT_TRUE(connection_->Execute("INSERT INTO t (id) VALUES (3)").ok());
  ASSERT_TRUE(kept->Release().ok());
  ASSERT_TRUE(transaction->Commit().ok());
  EXPECT_EQ(*QueryInt64(*connection_, "SELECT SUM(id) FROM t"), 4);
}

// Catches the loss of what FULL and WAL promise, and settings that a new connection forgets.
TEST(SqliteFile, SettingsOfEveryConnection) {
  TemporaryFolder folder;
  const std::string path = folder.Path("a.db");
  const auto writer = OpenSqlite(path, Access::kWrite);
  ASSERT_TRUE(writer.ok()) << writer.status();
  const auto reader = OpenSqlite(path, Access::kRead);
  ASSERT_TRUE(reader.ok()) << reader.status();
  for (Connection* connection : {writer->get(), reader->get()}) {
    Connection& open = *connection;
    EXPECT_EQ(*QueryInt64(open, "PRAGMA synchronous"), 2) << "FULL";
    EXPECT_EQ(*QueryInt64(open, "PRAGMA foreign_keys"), 1);
    auto mode = Query(open, "PRAGMA journal_mode");
    ASSERT_TRUE(*(*mode)->Step());
    EXPECT_EQ((*mode)->Text(0), "wal");
  }
  EXPECT_FALSE((*reader)->Execute("CREATE TABLE t (id INTEGER)").ok()) << "a reader can't write";
}

// Catches two writers that wait for ever, or fail in a way that nobody runs again.
TEST(SqliteFile, ABusyDatabaseIsRetryable) {
  TemporaryFolder folder;
  const std::string path = folder.Path("a.db");
  const auto one = OpenSqlite(path, Access::kWrite);
  const auto two = OpenSqlite(path, Access::kWrite);
  ASSERT_TRUE((*two)->Execute("PRAGMA busy_timeout = 1").ok());
  auto held = Transaction::Begin(**one, Access::kWrite);
  const absl::Status busy = (*two)->Begin(Access::kWrite);
  EXPECT_EQ(busy.code(), absl::StatusCode::kAborted);
  EXPECT_TRUE(IsRetryable(busy));
  EXPECT_FALSE(IsRetryable(absl::AbortedError("a contradiction in the data")));
}

}  // namespace
}  // namespace truepose::store::sql
