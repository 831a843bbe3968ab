#include "server/store/migrations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <memory>
#include <string>
#include <vector>

#include "server/store/sql/query.h"
#include "server/store/sql/sqlite.h"
#include "tests/store/testing/fake_clock.h"
#include "tests/store/testing/faulty_connection.h"
#include "tests/store/testing/samples.h"
#include "truepose/v1/watch.pb.h"

namespace truepose::store {
namespace {

using ::testing::HasSubstr;

const FakeClock kClock;

std::unique_ptr<sql::Connection> Memory() {
  return *sql::OpenSqlite(":memory:", sql::Access::kWrite);
}

absl::Status MigrateTo(sql::Connection& connection, std::span<const Migration> known) {
  return Migrate(connection, known, kClock, "test.db");
}

// The text of every table and index, which says all about the form.
std::vector<std::string> Schema(sql::Connection& connection) {
  std::vector<std::string> texts;
  auto rows =
      sql::Query(connection, "SELECT sql FROM sqlite_master WHERE sql IS NOT NULL ORDER BY name");
  while (*(*rows)->Step()) texts.push_back((*rows)->Text(0));
  return texts;
}

// Catches files that are out of order, misnumbered, or without the line that newer databases depend
// on.
TEST(Migrations, TheEmbeddedOnesAreWellFormed) {
  int number = 0;
  for (const Migration& migration : EmbeddedMigrations()) {
    EXPECT_EQ(migration.number, ++number);
    EXPECT_FALSE(migration.name.empty());
    EXPECT_TRUE(migration.sql.starts_with("-- min_compatible: ")) << migration.name;
  }
  EXPECT_GE(number, 7);
}

// Catches tables that take a text where a number belongs.
TEST(Migrations, EveryTableIsStrict) {
  const auto connection = Memory();
  ASSERT_TRUE(MigrateTo(*connection, EmbeddedMigrations()).ok());
  EXPECT_EQ(*sql::QueryInt64(
                *connection,
                "SELECT COUNT(*) FROM pragma_table_list WHERE schema = 'main' AND type = 'table' "
                "AND name NOT LIKE 'sqlite_%' AND strict = 0"),
            0);
}

// Catches an upgrade that ends elsewhere than a new database: from every old version.
TEST(Migrations, EveryOldVersionIsUpgraded) {
  const auto fresh = Memory();
  ASSERT_TRUE(MigrateTo(*fresh, EmbeddedMigrations()).ok());
  for (size_t old = 0; old <= EmbeddedMigrations().size(); ++old) {
    const auto connection = Memory();
    ASSERT_TRUE(MigrateTo(*connection, EmbeddedMigrations().first(old)).ok());
    EXPECT_EQ(*connection->SchemaVersion(), static_cast<int64_t>(old));
    ASSERT_TRUE(MigrateTo(*connection, EmbeddedMigrations()).ok()) << "from " << old;
    EXPECT_EQ(Schema(*connection), Schema(*fresh)) << "from " << old;
    EXPECT_EQ(*connection->SchemaVersion(), *fresh->SchemaVersion());
  }
}

// Catches an upgrade that loses rows.
TEST(Migrations, AnUpgradeKeepsWhatIsThere) {
  const auto connection = Memory();
  ASSERT_TRUE(MigrateTo(*connection, EmbeddedMigrations().first(2)).ok());
  ASSERT_TRUE(connection->Execute("INSERT INTO robots VALUES ('ur10', x'0a')").ok());
  ASSERT_TRUE(MigrateTo(*connection, EmbeddedMigrations()).ok());
  EXPECT_EQ(*sql::QueryInt64(*connection, "SELECT COUNT(*) FROM robots WHERE id = 'ur10'"), 1);
}

// Catches a table of an older store whose bytes are never found by their digest or never go, and a
// request that nobody looks at any more.
TEST(Migrations, AnUpgradeNotesFilesAndWhatMayBeOpen) {
  const auto connection = Memory();
  ASSERT_TRUE(MigrateTo(*connection, EmbeddedMigrations().first(10)).ok());
  const std::string digest(64, 'a');
  const auto add = [&](int number, int kind, bool deleted, const std::string& message) {
    ASSERT_TRUE(sql::Run(*connection,
                         "INSERT INTO resources (sequence, kind, robot_id, id, deleted, message) "
                         "VALUES ($1, $2, 'ur10', $1, $3, $4)",
                         number, kind, deleted ? 1 : 0, sql::BlobView{message})
                    .ok());
  };
  add(1, v1::KIND_COMPENSATION_TABLE, false, std::string("\x01\0J@", 4) + digest + "\x02");
  add(2, v1::KIND_COMPENSATION_TABLE, true, "J@" + digest);
  add(3, v1::KIND_COMPENSATION_TABLE, false, "one that is building");
  add(4, v1::KIND_RECALIBRATION_REQUEST, false, "");
  add(5, v1::KIND_RECALIBRATION_POLICY, false, "");
  ASSERT_TRUE(sql::Run(*connection, "INSERT INTO files VALUES (1, $1, 3)", digest).ok());
  ASSERT_TRUE(MigrateTo(*connection, EmbeddedMigrations()).ok());
  const auto count = [&](const std::string& what) {
    return *sql::QueryInt64(*connection, "SELECT COUNT(*) FROM " + what);
  };
  EXPECT_EQ(count("table_files"), 2);
  EXPECT_EQ(count("table_files WHERE resource = 1 AND deleted_us = 0"), 1);
  EXPECT_EQ(count("table_files WHERE resource = 2 AND deleted_us > 1700000000000000"), 1);
  EXPECT_EQ(count("resources WHERE open = 1 AND sequence IN (4, 5)"), 2);
  EXPECT_EQ(count("resources WHERE open = 1"), 2);
}

// Catches a half applied migration: a fault at each statement leaves a whole version, and the next
// try ends the way.
TEST(Migrations, AnInterruptionLeavesTheVersionBefore) {
  const auto fresh = Memory();
  ASSERT_TRUE(MigrateTo(*fresh, EmbeddedMigrations()).ok());
  std::vector<std::vector<std::string>> schemas;
  for (size_t version = 0; version <= EmbeddedMigrations().size(); ++version) {
    const auto connection = Memory();
    ASSERT_TRUE(MigrateTo(*connection, EmbeddedMigrations().first(version)).ok());
    schemas.push_back(Schema(*connection));
  }
  for (int64_t at = 1;; ++at) {
    auto plan = std::make_shared<FaultPlan>();
    const auto connection = Faulty(plan)(Memory());
    plan->fault_at = at;
    const absl::Status status = MigrateTo(*connection, EmbeddedMigrations());
    if (!plan->HasStruck()) break;
    EXPECT_FALSE(status.ok()) << "statement " << at;
    EXPECT_EQ(Schema(*connection), schemas[*connection->SchemaVersion()]) << "statement " << at;
    ASSERT_TRUE(MigrateTo(*connection, EmbeddedMigrations()).ok()) << "statement " << at;
    EXPECT_EQ(Schema(*connection), Schema(*fresh)) << "statement " << at;
  }
}

// Catches a migration with an error in it that leaves a part of itself.
TEST(Migrations, AMigrationWithAnErrorLeavesNothing) {
  std::vector<Migration> known(EmbeddedMigrations().begin(), EmbeddedMigrations().end());
  const int broken = static_cast<int>(known.size()) + 1;
  known.push_back(
      {broken, "broken",
       "-- min_compatible: 1\nCREATE TABLE half (id INTEGER) STRICT;\nCREATE TABLE ();\n"});
  const auto connection = Memory();
  EXPECT_FALSE(MigrateTo(*connection, known).ok());
  EXPECT_EQ(*connection->SchemaVersion(), broken - 1);
  EXPECT_EQ(*sql::QueryInt64(*connection, "SELECT COUNT(*) FROM sqlite_master WHERE name = 'half'"),
            0);
}

// Catches an older program that writes into a form it doesn't understand.
TEST(Migrations, ANewerDatabaseIsRefusedUnlessItIsCompatible) {
  for (const auto& [min_compatible, is_refused] : {std::pair{"5", true}, std::pair{"4", false}}) {
    const std::string text = std::string("-- min_compatible: ") + min_compatible +
                             "\nCREATE TABLE later (id INTEGER) STRICT;\n";
    std::vector<Migration> newer(EmbeddedMigrations().begin(), EmbeddedMigrations().begin() + 4);
    newer.push_back({5, "later", text});
    const auto connection = Memory();
    ASSERT_TRUE(MigrateTo(*connection, newer).ok());
    const absl::Status status = MigrateTo(*connection, EmbeddedMigrations().first(4));
    EXPECT_EQ(absl::IsFailedPrecondition(status), is_refused) << status;
    EXPECT_EQ(status.ok(), !is_refused) << status;
    EXPECT_EQ(*connection->SchemaVersion(), 5);
  }
}

// Catches two databases of one version that differ.
TEST(Migrations, AChangedTextIsRefused) {
  const auto connection = Memory();
  ASSERT_TRUE(MigrateTo(*connection, EmbeddedMigrations()).ok());
  std::vector<Migration> changed(EmbeddedMigrations().begin(), EmbeddedMigrations().end());
  const std::string text = std::string(changed[2].sql) + "-- a comment\n";
  changed[2].sql = text;
  const absl::Status status = MigrateTo(*connection, changed);
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(std::string(status.message()), HasSubstr("migration 3 (sessions)"));
  EXPECT_EQ(FaultFields(status), std::vector<std::string>{"test.db"});
}

}  // namespace
}  // namespace truepose::store
