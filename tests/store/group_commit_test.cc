#include "server/store/group_commit.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "core/base/status_macros.h"
#include "server/store/migrations.h"
#include "server/store/sql/query.h"
#include "server/store/sql/sqlite.h"
#include "tests/store/testing/fake_clock.h"
#include "tests/store/testing/faulty_connection.h"

namespace truepose::store {
namespace {

const FakeClock kClock;

// A group of closures over a connection that fails where the test wants.
class GroupCommit : public ::testing::Test {
 protected:
  void SetUp() override { Reset(); }

  void Reset() {
    works_.clear();
    runs_.assign(10, 0);
    plan_ = std::make_shared<FaultPlan>();
    connection_ = Faulty(plan_)(*sql::OpenSqlite(":memory:", sql::Access::kWrite));
    ASSERT_TRUE(Migrate(*connection_, EmbeddedMigrations(), kClock, "test.db").ok());
    ASSERT_TRUE(connection_->Execute("INSERT INTO store (id, epoch, revision) VALUES (1, 'epoch', 0)").ok());
    ASSERT_TRUE(
        connection_->Execute("CREATE TABLE t (id INTEGER PRIMARY KEY, part INTEGER) STRICT").ok());
    plan_->statements = 0;
  }

  // Writes two rows with `id` and then answers `end`.
  void Add(int id, absl::Status end = absl::OkStatus()) {
    works_.push_back(std::make_unique<Work>());
    works_.back()->closure = [this, id, end](Transaction& transaction) -> absl::Status {
      ++runs_[id];
      for (int part = 0; part < 2; ++part) {
        TRUEPOSE_RETURN_IF_ERROR(
            sql::Run(transaction.sql(), "INSERT INTO t VALUES ($1, $2)", 10 * id + part, id));
      }
      return end;
    };
  }

  void Commit() {
    std::vector<Work*> group;
    for (const auto& work : works_) group.push_back(work.get());
    CommitGroup(*connection_, kClock, group);
  }

  int64_t Rows(int id) {
    return *sql::QueryInt64(*connection_, "SELECT COUNT(*) FROM t WHERE part = $1", id);
  }
  int64_t Revision() { return *sql::QueryInt64(*connection_, "SELECT revision FROM store"); }

  std::vector<std::unique_ptr<Work>> works_;
  std::vector<int> runs_;
  std::shared_ptr<FaultPlan> plan_;
  std::unique_ptr<sql::Connection> connection_;
};

// Catches a commit per closure, which would cost a sync of the disk each.
TEST_F(GroupCommit, AGroupIsOneCommit) {
  for (int id = 1; id <= 3; ++id) Add(id);
  plan_->only = "COMMIT";
  Commit();
  for (int id = 1; id <= 3; ++id) EXPECT_EQ(Rows(id), 2);
  EXPECT_EQ(plan_->statements, 1);
  EXPECT_EQ(Revision(), 1);
}

// Catches a failure that takes its neighbours with it, or leaves a part of itself.
TEST_F(GroupCommit, AFailingClosureRollsBackAlone) {
  Add(1);
  Add(2, absl::InvalidArgumentError("no"));
  Add(3);
  Commit();
  EXPECT_TRUE(works_[0]->result.ok());
  EXPECT_EQ(works_[1]->result, absl::InvalidArgumentError("no"));
  EXPECT_TRUE(works_[2]->result.ok());
  EXPECT_EQ(Rows(1), 2);
  EXPECT_EQ(Rows(2), 0);
  EXPECT_EQ(Rows(3), 2);
  EXPECT_EQ(runs_[1], 1) << "nobody ran again";
}

// Catches an answer that is given although the commit failed, and closures that stay undone after
// it.
TEST_F(GroupCommit, AFailedCommitRunsEachClosureAlone) {
  Add(1);
  Add(2, absl::InvalidArgumentError("no"));
  Add(3);
  plan_->only = "COMMIT";
  plan_->fault_at = 1;
  Commit();
  EXPECT_TRUE(works_[0]->result.ok());
  EXPECT_EQ(works_[1]->result, absl::InvalidArgumentError("no"));
  EXPECT_TRUE(works_[2]->result.ok());
  for (int id : {1, 3}) EXPECT_EQ(Rows(id), 2);
  for (int id : {1, 2, 3}) EXPECT_EQ(runs_[id], 2);
  EXPECT_EQ(Revision(), 2) << "one commit each for the two";
}

// Catches a lone closure whose failed commit is called a success.
TEST_F(GroupCommit, AFailedCommitOfOneClosureIsItsResult) {
  Add(1);
  plan_->only = "COMMIT";
  plan_->fault_at = 1;
  Commit();
  EXPECT_EQ(works_[0]->result.code(), absl::StatusCode::kUnavailable);
  EXPECT_EQ(Rows(1), 0);
  EXPECT_EQ(Revision(), 0);
}

// Catches a driver's wish to run again that is handed to the caller, or followed for ever.
TEST_F(GroupCommit, ARetryableClosureRunsAgain) {
  Add(1);
  Add(2);
  plan_->only = "INSERT";
  plan_->fault_at = 2;
  plan_->fault = [] { return sql::Retryable("busy"); };
  Commit();
  EXPECT_TRUE(works_[0]->result.ok()) << works_[0]->result;
  EXPECT_TRUE(works_[1]->result.ok());
  EXPECT_EQ(runs_[1], 2);
  Reset();
  Add(1, sql::Retryable("always"));
  Commit();
  EXPECT_EQ(works_[0]->result.code(), absl::StatusCode::kAborted);
  EXPECT_LT(runs_[1], 10);
}

// Catches, for a fault at any statement: a closure that is answered with OK but isn't stored whole,
// or is stored although it was answered with an error.
TEST_F(GroupCommit, AFaultAtEachStatement) {
  int64_t at = 1;
  for (;; ++at) {
    Reset();
    plan_->fault_at = at;
    Add(1);
    Add(2, absl::InvalidArgumentError("no"));
    Add(3);
    Commit();
    const bool struck = plan_->HasStruck();
    plan_->fault_at = 0;
    for (int id = 1; id <= 3; ++id) {
      EXPECT_EQ(Rows(id), works_[id - 1]->result.ok() ? 2 : 0)
          << "closure " << id << ", statement " << at;
    }
    EXPECT_FALSE(works_[1]->result.ok());
    EXPECT_LE(!works_[0]->result.ok() + !works_[2]->result.ok(), 1)
        << "one fault hurts one closure at most";
    if (!struck) break;
  }
  EXPECT_GT(at, 12) << "the faults were injected at all";
}

}  // namespace
}  // namespace truepose::store
