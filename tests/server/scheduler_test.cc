#include "server/scheduler.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <thread>

#include "server/scheduled_tasks.h"
#include "server/store/events.h"
#include "server/store/replies.h"
#include "server/store/robots.h"
#include "tests/server/testing/examples.h"
#include "tests/server/testing/expect_status.h"
#include "tests/store/testing/fake_clock.h"

namespace truepose::server {
namespace {

using testing::IsOk;

// Long enough for a loaded machine; a test that waits so long has failed.
constexpr std::chrono::seconds kPatience{30};

// Counts its runs, and lets a test wait for them.
class Counted {
 public:
  absl::Status Add() {
    const std::lock_guard lock(mutex_);
    ++count_;
    changed_.notify_all();
    return absl::InternalError("out of luck");
  }
  bool WaitFor(int count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return count_ >= count; });
  }
  int count() {
    const std::lock_guard lock(mutex_);
    return count_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int count_ = 0;
};

// Would catch a task that runs once only, more often than it should, or not after one that failed.
TEST(SchedulerTest, RunsEachTaskOnceARound) {
  store::FakeClock clock;
  Counted first, second;
  std::mutex mutex;
  std::vector<std::string> warnings;
  Scheduler scheduler({{.what = "first", .run = [&](const auto&) { return first.Add(); }},
                       {.what = "second", .run = [&](const auto&) { return second.Add(); }}},
                      absl::Minutes(1), clock, [&](const std::string& warning) {
                        const std::lock_guard lock(mutex);
                        warnings.push_back(warning);
                      });
  scheduler.Start();
  ASSERT_TRUE(second.WaitFor(1));
  clock.Advance(absl::Seconds(59));
  clock.Advance(absl::Seconds(1));
  ASSERT_TRUE(second.WaitFor(2));
  scheduler.Stop();
  EXPECT_EQ(first.count(), 2);
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(warnings.front(), "first: INTERNAL: out of luck");
}

// Would catch a stop that a long task isn't told of: this one would never end.
TEST(SchedulerTest, ATaskIsToldOfTheStop) {
  store::FakeClock clock;
  std::promise<void> began;
  const auto run = [&](const std::function<bool()>& is_stopping) {
    began.set_value();
    while (!is_stopping()) std::this_thread::yield();
    return absl::OkStatus();
  };
  Scheduler scheduler({{.what = "long", .run = run}}, absl::Minutes(1), clock,
                      [](const std::string&) {});
  scheduler.Start();
  began.get_future().wait();
  scheduler.Stop();
}

class ScheduledTasksTest : public ::testing::Test {
 protected:
  ScheduledTasksTest() {
    auto store = store::Store::Open({.path = ":memory:", .clock = &clock_});
    EXPECT_THAT(store, IsOk());
    store_ = *std::move(store);
  }

  void AddRobot(const std::string& id) {
    const auto added = store_->Write([&](store::Transaction& transaction) {
      return store::CreateRobot(transaction, id, testing::SixAxes(), id);
    });
    ASSERT_THAT(added, IsOk());
  }
  bool HistoryReachesTo(int64_t revision) {
    return store_
        ->Read([&](store::Snapshot& snapshot) {
          return store::EventsAfter(snapshot, revision, {}, 10, 10'000);
        })
        .ok();
  }

  store::FakeClock clock_;
  std::unique_ptr<store::Store> store_;
};

// Would catch a history that grows for ever, and a look at it that costs a commit.
TEST_F(ScheduledTasksTest, OldEventsAreForgottenAndNothingElseIsWritten) {
  const int64_t before = *store_->Revision();
  AddRobot("a");
  clock_.Advance(absl::Hours(23));
  AddRobot("b");
  const int64_t written = *store_->Revision();
  ASSERT_THAT(ForgetOldEvents(*store_), IsOk());
  EXPECT_TRUE(HistoryReachesTo(before));
  EXPECT_EQ(*store_->Revision(), written);
  clock_.Advance(absl::Hours(2));
  ASSERT_THAT(ForgetOldEvents(*store_), IsOk());
  EXPECT_FALSE(HistoryReachesTo(before));
  EXPECT_TRUE(HistoryReachesTo(before + 1)) << "b is of this day";
}

// Would catch answers that are kept for ever, or forgotten while they may still be asked for.
TEST_F(ScheduledTasksTest, OldRepliesAreForgotten) {
  const store::RequestKey key{
      .principal = "anna", .method = "m", .request_id = testing::kSession1, .digest = "d"};
  ASSERT_THAT(store_->Write([&](store::Transaction& transaction) {
    return store::KeepReply(transaction, key, "answer");
  }),
              IsOk());
  const auto is_kept = [&] {
    EXPECT_THAT(ForgetOldReplies(*store_), IsOk());
    const auto found =
        store_->Read([&](store::Snapshot& snapshot) { return store::FindReply(snapshot, key); });
    EXPECT_THAT(found, IsOk());
    return found->has_value();
  };
  clock_.Advance(absl::Hours(7 * 24 - 1));
  EXPECT_TRUE(is_kept());
  clock_.Advance(absl::Hours(2));
  EXPECT_FALSE(is_kept());
}

}  // namespace
}  // namespace truepose::server
