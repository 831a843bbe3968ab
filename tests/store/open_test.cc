// What Store::Open refuses: one clear fault each, and every file as it was.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <set>
#include <string>

#include "server/store/robots.h"
#include "server/store/store.h"
#include "tests/store/testing/faulty_connection.h"
#include "tests/store/testing/samples.h"
#include "tests/store/testing/temporary_folder.h"

namespace truepose::store {
namespace {

using Files = std::set<std::string>;

// Writes with SQLite itself, as another program would.
void Sqlite(const std::string& path, const char* sql) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  ASSERT_EQ(sqlite3_close(database), SQLITE_OK);
}

class Open : public ::testing::Test {
 protected:
  absl::Status Refusal() { return Store::Open({.path = path_}).status(); }

  // The file stays byte for byte, alone in its folder.
  void ExpectRefused(const std::string& word) {
    const std::string before = ReadFile(path_);
    const absl::Status status = Refusal();
    EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
    EXPECT_THAT(std::string(status.message()), ::testing::HasSubstr(word));
    EXPECT_EQ(FaultFields(status).size(), 1u);
    EXPECT_TRUE(ReadFile(path_) == before) << "the file was changed";
    EXPECT_EQ(folder_.Files(), Files{"a.db"});
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.Path("a.db");
};

// Catches options that are checked one at a time, or not at all.
TEST_F(Open, AllFaultsOfTheOptionsAtOnce) {
  const absl::Status status = Store::Open({.path = "", .readers = 0, .max_group = 0}).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(FaultFields(status), (std::vector<std::string>{"path", "readers", "max_group"}));
}

// Catches a database that everybody on the machine can read.
TEST_F(Open, ANewDatabaseIsItsOwnersAlone) {
  ASSERT_TRUE(Store::Open({.path = path_}).ok());
  struct stat status;
  ASSERT_EQ(stat(path_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, S_IRUSR | S_IWUSR);
}

// Catches data that don't survive an orderly end, an epoch that changes, and files left by one.
TEST_F(Open, WhatWasWrittenIsThereAgain) {
  std::string epoch;
  {
    const auto store = Store::Open({.path = path_});
    ASSERT_TRUE(store.ok()) << store.status();
    AddRobot(**store, "ur10");
    epoch = (*store)->epoch();
  }
  EXPECT_EQ(folder_.Files(), Files{"a.db"});
  const auto store = Store::Open({.path = path_});
  ASSERT_TRUE(store.ok()) << store.status();
  EXPECT_EQ((*store)->epoch(), epoch);
  EXPECT_EQ(*(*store)->Revision(), 1);
  EXPECT_TRUE(
      (*store)->Read([](Snapshot& snapshot) { return GetRobot(snapshot, "robots/ur10"); }).ok());
}

TEST_F(Open, AFolderThatDoesNotExist) {
  const absl::Status status = Store::Open({.path = folder_.Path("none/a.db")}).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(status.message()), ::testing::HasSubstr("none"));
  EXPECT_EQ(folder_.Files(), Files{});
}

TEST_F(Open, AFileThatIsNoDatabase) {
  WriteFile(path_, "q1_rad,x_mm\n0,1\n");
  ExpectRefused("not a database");
}

TEST_F(Open, ADamagedDatabase) {
  WriteFile(path_, std::string("SQLite format 3\0", 16) + std::string(4080, 'x'));
  ExpectRefused("SQLite can't read");
}

TEST_F(Open, ADatabaseOfAnotherProgram) {
  Sqlite(path_, "CREATE TABLE recipes (id INTEGER); INSERT INTO recipes VALUES (1)");
  ExpectRefused("another program");
}

TEST_F(Open, AFolderInPlaceOfAFile) {
  ASSERT_EQ(mkdir(path_.c_str(), 0755), 0);
  EXPECT_EQ(Refusal().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(folder_.Files(), Files{"a.db"});
}

TEST_F(Open, ADatabaseOfANewerVersion) {
  ASSERT_TRUE(Store::Open({.path = path_}).ok());
  Sqlite(
      path_,
      "INSERT INTO migrations VALUES (1000, 'future', 'x', 1000, '2030-01-01T00:00:00Z'); PRAGMA "
      "user_version = 1000");
  ExpectRefused("version 1000");
}

// Catches a refusal of what says that it is compatible.
TEST_F(Open, ANewerDatabaseThatIsCompatible) {
  ASSERT_TRUE(Store::Open({.path = path_}).ok());
  Sqlite(path_,
         "INSERT INTO migrations VALUES (1000, 'future', 'x', 1, '2030-01-01T00:00:00Z'); PRAGMA "
         "user_version = 1000");
  EXPECT_TRUE(Store::Open({.path = path_}).ok());
}

TEST_F(Open, AMigrationThatWasChangedAfterwards) {
  ASSERT_TRUE(Store::Open({.path = path_}).ok());
  Sqlite(path_, "UPDATE migrations SET sha256 = 'other' WHERE number = 2");
  ExpectRefused("migration 2");
}

// The superuser may write everything, so this also holds for a file that is only marked.
TEST_F(Open, AReadOnlyFile) {
  ASSERT_TRUE(Store::Open({.path = path_}).ok());
  ASSERT_EQ(chmod(path_.c_str(), 0444), 0);
  ExpectRefused("read-only");
}

// As another user, when this is the superuser, for whom no folder is read-only.
TEST_F(Open, AReadOnlyFolder) {
  ASSERT_EQ(chmod(folder_.Path("").c_str(), 0555), 0);
  const pid_t child = fork();
  if (child == 0) {
    if (getuid() == 0 && setuid(65534) != 0) _exit(2);
    _exit(absl::IsFailedPrecondition(Refusal()) ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  ASSERT_EQ(chmod(folder_.Path("").c_str(), 0755), 0);
  EXPECT_EQ(folder_.Files(), Files{});
}

// Catches a new database that is left behind half made: a fault at each statement of the opening.
TEST_F(Open, AnOpeningThatFailsLeavesNoFile) {
  int64_t faults = 0;
  for (int64_t at = 1;; ++at) {
    auto plan = std::make_shared<FaultPlan>();
    plan->fault_at = at;
    const auto store = Store::Open({.path = path_, .decorate_writer = Faulty(plan)});
    if (store.ok() && !plan->HasStruck()) break;
    ++faults;
    // A rollback that fails is the database's own affair; everything else is told.
    EXPECT_FALSE(store.ok()) << "statement " << at;
    EXPECT_EQ(folder_.Files(), Files{}) << "statement " << at;
  }
  EXPECT_GT(faults, 10) << "the faults were injected at all";
}

}  // namespace
}  // namespace truepose::store
