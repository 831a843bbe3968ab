// Rounds in which everything breaks: the network is cut, slow, lossy and stalled, server and agent
// are killed, the server is restored from an older copy, the spool's disk is full. What sources
// were answered for is then what the server has: nothing lost, nothing doubled, in its order.
#include <atomic>
#include <cstdlib>
#include <iostream>
#include <random>

#include "absl/strings/str_cat.h"
#include "gtest/gtest.h"
#include "tests/agent/testing/plant.h"

namespace truepose {
namespace {

constexpr int kSources = 3;
constexpr int64_t kReadings = 400;  // of each
constexpr int kFaults = 8;          // of a round

bool IsLong() {
  const char* const wish = std::getenv("TRUEPOSE_LONG");
  return wish != nullptr && *wish != '\0';
}

class Round {
 public:
  explicit Round(unsigned seed) : random_(seed), plant_(seed) { plant_.StartAgent(); }

  // @param long_cut whether the network is gone for half a minute first.
  void Play(bool long_cut);

 private:
  int Draw(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }
  std::string Id(int source) const {
    return absl::StrCat("00000000-0000-4000-8000-00000000000", source);
  }
  void Break();
  void BreakNetwork();
  void RestartServer(bool restore);
  // Until so many more readings were taken, so that faults fall between readings, or a time is
  // over.
  void Pass(int64_t readings, std::chrono::milliseconds most) const;

  std::mt19937 random_;
  testing::Plant plant_;
  bool has_backup_ = false;
  std::atomic<int64_t> taken_{0};
  std::string story_;
};

void Round::Pass(int64_t readings, std::chrono::milliseconds most) const {
  const auto end = std::chrono::steady_clock::now() + most;
  const int64_t wanted = taken_ + readings;
  while (taken_ < wanted && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void Round::BreakNetwork() {
  const std::chrono::milliseconds time{Draw(50, 500)};
  switch (Draw(0, 3)) {
    case 0:
      story_ += " cut";
      plant_.network().Cut();
      break;
    case 1:
      story_ += " slow";
      plant_.network().Delay(Draw(5, 50));
      break;
    case 2:
      story_ += " loss";
      plant_.network().Drop(10);
      break;
    default:
      story_ += " stalled";
      plant_.network().Stall();
  }
  Pass(1'000'000, time);
  plant_.network().Heal();
}

void Round::RestartServer(bool restore) {
  story_ += restore ? " restored" : " server";
  plant_.KillServer();
  if (restore) plant_.Restore();
  if (!has_backup_) plant_.Backup();
  has_backup_ = true;
  Pass(Draw(0, 20), std::chrono::milliseconds(300));
  plant_.StartServer();
}

void Round::Break() {
  Pass(Draw(1, 100), std::chrono::milliseconds(500));
  switch (Draw(0, 4)) {
    case 0:
      return RestartServer(false);
    case 1:
      return RestartServer(has_backup_);
    case 2:
      story_ += " agent";
      plant_.agent().Kill();
      return plant_.StartAgent();
    case 3:
      story_ += " full";
      plant_.agent().LimitFiles(Draw(1'000, 20'000));
      Pass(30, std::chrono::milliseconds(200));
      return plant_.agent().LimitFiles(0);
    default:
      return BreakNetwork();
  }
}

void Round::Play(bool long_cut) {
  std::vector<int64_t> answered(kSources);
  std::vector<std::thread> sources;
  std::vector<std::string> ids;
  for (int source = 0; source < kSources; ++source) {
    ids.push_back(Id(source));
    sources.emplace_back([&, source] {
      answered[source] = testing::MeasureThrough(plant_, Id(source), kReadings, [&] { ++taken_; });
    });
  }
  if (long_cut) {
    story_ += " half a minute";
    plant_.network().Cut();
    Pass(1'000'000, std::chrono::seconds(30));
    plant_.network().Heal();
  }
  for (int fault = 0; fault < kFaults; ++fault) Break();
  for (std::thread& source : sources) source.join();
  // One more when all is taken: what is done has to come again as well.
  if (has_backup_) RestartServer(true);
  EXPECT_TRUE(plant_.WaitUntilSealed(ids)) << story_ << "\n" << plant_.agent().Output();
  for (int source = 0; source < kSources; ++source) {
    EXPECT_EQ(answered[source], kReadings);
    std::vector<int64_t> expected;
    for (int64_t number = 1; number <= kReadings; ++number) expected.push_back(number);
    EXPECT_EQ(plant_.Stored(Id(source)), expected) << story_ << "\n" << plant_.agent().Output();
  }
  std::cout << "round:" << story_ << std::endl;
}

// Would catch a reading that any fault, or any two of them, loses, doubles or moves.
TEST(FaultsTest, NothingIsLostAndNothingDoubled) {
  const int rounds = IsLong() ? 50 : 3;
  for (int round = 0; round < rounds && !::testing::Test::HasFailure(); ++round) {
    SCOPED_TRACE(absl::StrCat("seed ", round));
    Round(static_cast<unsigned>(round)).Play(IsLong() && round % 10 == 0);
  }
}

}  // namespace
}  // namespace truepose
