#include "server/jobs/watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <thread>

#include "server/jobs/engine.h"
#include "server/store/names.h"
#include "tests/jobs/engine_testing.h"
#include "tests/store/testing/samples.h"

namespace truepose::jobs {
namespace {

using ::testing::ElementsAre;

class Watch : public ::testing::Test {
 protected:
  void SetUp() override {
    auto store = store::Store::Open({.path = ":memory:"});
    ASSERT_TRUE(store.ok()) << store.status();
    store_ = *std::move(store);
    store::AddRobotWithSession(*store_);
    name_ = store::AddJob(*store_, 1);
    engine_ = std::make_unique<JobEngine>(*store_, runner_.AsRunner(), QuickOptions());
  }
  // From the job that waits to the job that runs.
  void StartRunning() {
    ASSERT_TRUE(engine_->Start().ok());
    ASSERT_TRUE(runner_.WaitForRuns(1));
  }

  std::unique_ptr<store::Store> store_;
  std::string name_;
  HandRunner runner_;  // outlives the engine
  std::unique_ptr<JobEngine> engine_;
};

std::vector<v1::JobState> States(const Watching& watching) {
  std::vector<v1::JobState> states;
  for (const v1::CalibrationJob& job : watching.Seen()) states.push_back(job.state());
  return states;
}

// Catches a state that isn't told, told twice, or out of order, and a watch that doesn't end.
TEST_F(Watch, TheJobNowThenEachStateThenTheEnd) {
  Watching watching(*engine_, name_);
  ASSERT_TRUE(watching.WaitForState(v1::PENDING));
  StartRunning();
  ASSERT_TRUE(watching.WaitForState(v1::RUNNING));
  runner_.EndWith(store::SampleCalibration());
  EXPECT_TRUE(watching.WaitForEnd().ok());
  EXPECT_THAT(States(watching), ElementsAre(v1::PENDING, v1::RUNNING, v1::SUCCEEDED));
  EXPECT_EQ(watching.Seen().back().calibration(), "robots/ur10/calibrations/1");
}

// Catches a watch of what has ended that waits for ever.
TEST_F(Watch, AJobThatHasEndedIsToldOnce) {
  runner_.EndWith(store::SampleCalibration());
  ASSERT_TRUE(engine_->Start().ok());
  Finish(*engine_, name_);
  Watching watching(*engine_, name_);
  EXPECT_TRUE(watching.WaitForEnd().ok());
  EXPECT_THAT(States(watching), ElementsAre(v1::SUCCEEDED));
}

// Catches progress that isn't told, that is stored, or that stays after the end.
TEST_F(Watch, ProgressIsToldAndNeverStored) {
  Watching watching(*engine_, name_);
  StartRunning();
  const int64_t revision = *store_->Revision();
  for (const double fraction : {0.25, 0.5}) {
    runner_.Report(fraction);
    EXPECT_TRUE(watching.WaitFor(
        [&](const v1::CalibrationJob& job) { return job.progress().fraction() == fraction; }));
  }
  EXPECT_EQ(engine_->Get(name_)->progress().fraction(), 0.5);
  EXPECT_FALSE(Stored(*store_, name_).has_progress());
  EXPECT_EQ(*store_->Revision(), revision);
  runner_.EndWith(store::SampleCalibration());
  EXPECT_TRUE(watching.WaitForEnd().ok());
  EXPECT_FALSE(watching.Seen().back().has_progress());
}

// Catches a slow watcher that piles up changes, or misses the last one.
TEST_F(Watch, ChangesMeltTogetherForASlowWatcher) {
  StartRunning();
  std::promise<void> first, go_on, done;
  std::atomic<int> told = 0;
  WatchCallbacks callbacks;
  callbacks.on_job = [&](const v1::CalibrationJob&) {
    if (++told == 1) {
      first.set_value();
      go_on.get_future().wait();
    }
  };
  callbacks.on_done = [&](const absl::Status&) { done.set_value(); };
  const auto subscription = engine_->Watch(name_, callbacks);
  first.get_future().wait();
  for (int i = 1; i <= 500; ++i) runner_.Report(i / 500.0);
  runner_.EndWith(store::SampleCalibration());
  // The end is stored while the watcher still sits on the first message.
  while (Stored(*store_, name_).state() != v1::SUCCEEDED) std::this_thread::yield();
  go_on.set_value();
  ASSERT_EQ(done.get_future().wait_for(kPatience), std::future_status::ready);
  EXPECT_EQ(told, 2) << "the first, and the last for all that came between";
}

// Catches a callback after the subscription is gone: its destructor waits for the one that runs.
TEST_F(Watch, NoCallbackAfterTheSubscription) {
  StartRunning();
  std::promise<void> inside, go_on;
  std::atomic<bool> gone = false, late = false;
  std::atomic<int> told = 0;
  WatchCallbacks callbacks;
  callbacks.on_job = [&](const v1::CalibrationJob&) {
    late = late || gone;
    if (++told > 1) return;
    inside.set_value();
    go_on.get_future().wait();
    late = late || gone;
  };
  auto subscription = engine_->Watch(name_, callbacks);
  inside.get_future().wait();
  std::thread remover([&] {
    *subscription = nullptr;
    gone = true;
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(gone) << "the callback still runs";
  go_on.set_value();
  remover.join();
  runner_.EndWith(store::SampleCalibration());
  Finish(*engine_, name_);
  EXPECT_FALSE(late);
  EXPECT_EQ(told, 1);
}

// Catches a deadlock of a watcher that goes from within its own callback, and a last word to it.
TEST_F(Watch, ASubscriptionMayEndWithinItsCallback) {
  runner_.EndWith(store::SampleCalibration());
  ASSERT_TRUE(engine_->Start().ok());
  Finish(*engine_, name_);
  std::unique_ptr<Subscription> subscription;
  std::promise<void> assigned, ended;
  std::atomic<bool> done = false;
  WatchCallbacks callbacks;
  callbacks.on_job = [&](const v1::CalibrationJob&) {
    assigned.get_future().wait();
    subscription = nullptr;
    ended.set_value();
  };
  callbacks.on_done = [&](const absl::Status&) { done = true; };
  subscription = *engine_->Watch(name_, callbacks);
  assigned.set_value();
  ASSERT_EQ(ended.get_future().wait_for(kPatience), std::future_status::ready);
  Finish(*engine_, name_);  // the hub has gone on to the next watch
  EXPECT_FALSE(done);
}

// Catches a callback under a lock: it may call the engine.
TEST_F(Watch, ACallbackMayCallTheEngine) {
  StartRunning();
  std::promise<absl::Status> done;
  WatchCallbacks callbacks;
  callbacks.on_job = [&](const v1::CalibrationJob& job) {
    EXPECT_TRUE(engine_->Get(name_).ok());
    if (job.state() == v1::RUNNING) {
      EXPECT_TRUE(engine_->Cancel(name_).ok());
    }
  };
  callbacks.on_done = [&](const absl::Status& status) { done.set_value(status); };
  const auto subscription = engine_->Watch(name_, callbacks);
  auto end = done.get_future();
  ASSERT_EQ(end.wait_for(kPatience), std::future_status::ready);
  EXPECT_TRUE(end.get().ok());
  EXPECT_EQ(Stored(*store_, name_).state(), v1::CANCELLED);
}

// Catches a watch that hangs when the server stops, and one that begins afterwards.
TEST_F(Watch, AStopEndsEveryWatch) {
  Watching one(*engine_, name_), two(*engine_, name_);
  StartRunning();
  engine_->Stop();
  EXPECT_EQ(one.WaitForEnd().code(), absl::StatusCode::kUnavailable);
  EXPECT_EQ(two.WaitForEnd().code(), absl::StatusCode::kUnavailable);
  EXPECT_EQ(engine_->Watch(name_, {}).status().code(), absl::StatusCode::kUnavailable);
  engine_ = nullptr;
  one.Unsubscribe();  // a subscription may outlive the engine
}

TEST_F(Watch, AnUnknownJob) {
  EXPECT_EQ(engine_->Watch(store::JobName(store::Uuid(9)), {}).status().code(),
            absl::StatusCode::kNotFound);
  EXPECT_EQ(engine_->Watch("job", {}).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace truepose::jobs
