// From an activation on a real server to what an agent runs.
#include "client/agent/released/released_keeper.h"

#include <filesystem>
#include <fstream>

#include "absl/strings/str_cat.h"
#include "gmock/gmock.h"
#include "tests/agent/released/release_fixture.h"
#include "tests/agent/released/released_testing.h"
#include "tests/server/testing/expect_status.h"

namespace truepose::agent {
namespace {

using ::testing::HasSubstr;
using truepose::testing::IsOk;

class ReleasedKeeperTest : public testing::ReleaseFixture {
 protected:
  ReleasedKeeperTest() : client_(NewClient()) {}
  void TearDown() override { keeper_.reset(); }

  void StartKeeper() {
    keeper_.reset();
    keeper_ = std::make_unique<ReleasedKeeper>(
        client_, disk_,
        ReleasedKeeperOptions{.robot = "robots/arm",
                              .folder = folder_.File("arm"),
                              .pause = std::chrono::milliseconds(20),
                              .longest_pause = std::chrono::milliseconds(100)},
        [this](const std::string& line) {
          std::lock_guard lock(mutex_);
          log_ += line + "\n";
        });
  }
  bool WaitUntilRuns(int number) {
    const std::string name = absl::StrCat("robots/arm/calibrations/", number);
    return WaitUntil([&] {
      const auto state = keeper_->state();
      return state->current != nullptr && state->current->entry().calibration == name &&
             state->current->table().header.calibration.view() == name;
    });
  }
  bool WaitForProblem(const std::string& part) {
    return WaitUntil([&] { return keeper_->state()->problem.find(part) != std::string::npos; });
  }
  std::string Log() {
    std::lock_guard lock(mutex_);
    return log_;
  }

  truepose::testing::TempDir folder_;
  Disk disk_;
  std::mutex mutex_;
  std::string log_;
  client::Client client_;
  std::unique_ptr<ReleasedKeeper> keeper_;
};

// Would catch an activation that nobody hears of, a roll back that is refused, and an agent that
// says nothing while there is none.
TEST_F(ReleasedKeeperTest, RunsWhatIsActive) {
  StartKeeper();
  ASSERT_TRUE(WaitUntil([&] {
    return keeper_->state()->waiting.find("no active calibration") != std::string::npos;
  }));
  Activate(1);
  ASSERT_TRUE(WaitUntilRuns(1)) << Log();
  Activate(2);
  ASSERT_TRUE(WaitUntilRuns(2)) << Log();
  RollBack();
  ASSERT_TRUE(WaitUntilRuns(1)) << Log();
  EXPECT_TRUE(WaitUntil([&] { return keeper_->state()->problem.empty(); })) << Log();
  EXPECT_EQ(keeper_->state()->former.at(0)->entry().calibration, "robots/arm/calibrations/2");
}

// Would catch an agent that needs its server to start, or that loses what it ran.
TEST_F(ReleasedKeeperTest, StartsFromTheCacheWithoutAServer) {
  Activate(1);
  StartKeeper();
  ASSERT_TRUE(WaitUntilRuns(1)) << Log();
  keeper_.reset();
  StopServer();
  StartKeeper();
  ASSERT_TRUE(WaitUntilRuns(1)) << Log();
  EXPECT_THAT(Log(), HasSubstr("from the cache"));
  Restart();
  Activate(2);
  ASSERT_TRUE(WaitUntilRuns(2)) << "it finds the server when it comes back" << Log();
}

// Would catch a damaged cache that stays so though a server is there.
TEST_F(ReleasedKeeperTest, ADamagedCacheIsFetchedAgain) {
  Activate(1);
  StartKeeper();
  ASSERT_TRUE(WaitUntilRuns(1));
  const std::string sha256 = keeper_->state()->current->entry().sha256;
  keeper_.reset();
  std::ofstream(folder_.File("arm/" + sha256 + ".table"), std::ios::binary) << "broken";
  StopServer();
  StartKeeper();
  ASSERT_TRUE(WaitForProblem("is not used"));
  Restart();
  ASSERT_TRUE(WaitUntilRuns(1)) << Log();
  EXPECT_TRUE(WaitUntil([&] { return keeper_->state()->problem.empty(); }));
}

// Would catch agents that go back with a server that was restored from an older copy, or that stay
// behind for ever.
TEST_F(ReleasedKeeperTest, ARestoredServerDoesNotTakeThemBack) {
  Activate(1);
  StartKeeper();
  ASSERT_TRUE(WaitUntilRuns(1));
  StopServer();
  const std::string copy = folder_.File("copy");
  std::filesystem::copy_file(options_.database, copy);
  Restart();
  Activate(2);
  ASSERT_TRUE(WaitUntilRuns(2)) << Log();
  StopServer();
  for (const char* suffix : {"", "-wal", "-shm"})
    std::filesystem::remove(options_.database + suffix);
  std::filesystem::copy_file(copy, options_.database);
  Restart();
  ASSERT_TRUE(WaitForProblem("restored from an older copy")) << Log();
  EXPECT_TRUE(WaitUntilRuns(2));
  Activate(2);
  EXPECT_TRUE(WaitUntil([&] { return keeper_->state()->problem.empty(); })) << Log();
  RollBack();
  EXPECT_TRUE(WaitUntilRuns(1)) << Log();
}

// Would catch a server whose table is another robot's, or whose file is not what it announces.
TEST_F(ReleasedKeeperTest, ATableForSomethingElseIsRefused) {
  Activate(1);
  StartKeeper();
  ASSERT_TRUE(WaitUntilRuns(1));
  runner_.build_table = [](const v1::CompensationTableInput& input,
                           const jobs::RunnerHooks& hooks) {
    v1::CompensationTableInput other = input;
    other.set_robot("robots/other");
    return testing::TestTableBuilder()(other, hooks);
  };
  Restart();
  Activate(2);
  ASSERT_TRUE(WaitForProblem("another robot's: found robots/other")) << Log();
  EXPECT_TRUE(WaitUntilRuns(1));
  RollBack();
  EXPECT_TRUE(WaitUntil([&] { return keeper_->state()->problem.empty(); })) << Log();
}

}  // namespace
}  // namespace truepose::agent
