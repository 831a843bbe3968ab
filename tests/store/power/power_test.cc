// Losses of power under the store's own group commit. What was acknowledged must be there, whole,
// in a database that SQLite finds intact. With TRUEPOSE_LONG 2,000 losses, otherwise 100.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <random>

#include "tests/store/power/power_vfs.h"
#include "tests/store/power/store_load.h"
#include "tests/store/testing/temporary_folder.h"

namespace truepose::store {
namespace {

// A database lives through a few losses, so that what one leaves behind meets the next.
constexpr int kLossesOfALife = 5;

bool IsLongRun() { return std::getenv("TRUEPOSE_LONG") != nullptr; }

// Settings on top of the store's own, on the connection that writes.
sql::Decorator With(const std::string& settings) {
  return [settings](std::unique_ptr<sql::Connection> inner) {
    EXPECT_TRUE(inner->Execute(settings).ok()) << settings;
    return inner;
  };
}

class PowerLoss : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto store = Store::Open({.path = folder_.Path("template.db")});
    ASSERT_TRUE(store.ok()) << store.status();
    PrepareLoad(**store);
  }

  int64_t Draw(int64_t low, int64_t high) {
    return std::uniform_int_distribution<int64_t>(low, high)(random_);
  }

  // Loads the database until the power goes. @returns what was acknowledged.
  LoadCounts LoseOnce(const std::string& path, SimulatedDisk& disk, const std::string& settings) {
    // Few changes hit the opening and its recovery, many hit checkpoints.
    disk.CutPowerAt(Draw(0, 9) == 0 ? Draw(1, 15) : Draw(15, 600));
    LoadCounts acknowledged{};
    const auto store = Store::Open({.path = path, .decorate_writer = With(settings)});
    if (store.ok()) acknowledged = RunLoad(**store);
    EXPECT_TRUE(disk.is_off()) << store.status();
    return acknowledged;
  }

  // One database through its losses. Counts acknowledged effects that are gone.
  void Live(int life, const std::string& settings) {
    const std::string path = folder_.Path(std::to_string(life) + ".db");
    std::filesystem::copy_file(folder_.Path("template.db"), path);
    SimulatedDisk disk(static_cast<uint64_t>(life));
    const PowerVfs vfs(disk);
    for (int loss = 0; loss < kLossesOfALife; ++loss) {
      const LoadCounts acknowledged = LoseOnce(path, disk, settings);
      disk.Recover();
      const auto store = Store::Open({.path = path});
      ASSERT_TRUE(store.ok()) << store.status();
      const LoadCounts stored = CheckLoad(**store);
      for (int kind = 0; kind < kLoadKinds; ++kind) {
        lost_ += stored[kind] < acknowledged[kind] ? 1 : 0;
        acknowledged_ += acknowledged[kind];
      }
      ++losses_;
      if (HasFailure()) return;
    }
    std::filesystem::remove(path);
  }

  TemporaryFolder folder_;
  std::mt19937_64 random_{20260401};
  int losses_ = 0, lost_ = 0;
  int64_t acknowledged_ = 0;
};

// Would catch an answer before the sync, a setting that saves one, a group that is stored in part,
// and a checkpoint that trusts what isn't durable.
TEST_F(PowerLoss, NothingAcknowledgedIsLostAndNothingIsCorrupt) {
  const int losses = IsLongRun() ? 2000 : 100;
  for (int life = 0; losses_ < losses; ++life) {
    // SQLite's own interval of checkpoints is longer than a life.
    Live(life, life % 2 == 0 ? "PRAGMA wal_autocheckpoint = 30" : "");
    ASSERT_FALSE(HasFailure()) << "life " << life;
  }
  EXPECT_EQ(lost_, 0);
  EXPECT_GT(acknowledged_, 10 * losses) << "something was written at all";
  std::cout << losses_ << " losses of power, " << lost_ << " acknowledged effects lost\n";
}

// The control: without the sync of each commit the same losses must cost something, or the
// simulation proves nothing.
TEST_F(PowerLoss, WithoutSyncAtEachCommitAcknowledgedEffectsAreLost) {
  const int losses = IsLongRun() ? 300 : 40;
  for (int life = 0; losses_ < losses; ++life) {
    Live(life, "PRAGMA synchronous = NORMAL");
    ASSERT_FALSE(HasFailure()) << "NORMAL loses the latest commits, it corrupts nothing";
  }
  EXPECT_GT(lost_, losses / 2);
  std::cout << losses_ << " losses of power, " << lost_ << " acknowledged effects lost\n";
}

}  // namespace
}  // namespace truepose::store
