// RUNNING jobs that a process finds at its start, and leases that are lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <mutex>
#include <thread>
#include <utility>

#include "server/jobs/engine.h"
#include "server/jobs/transitions.h"
#include "server/store/names.h"
#include "tests/jobs/engine_testing.h"
#include "tests/store/testing/samples.h"

namespace truepose::jobs {
namespace {

using ::testing::HasSubstr;

class Restart : public ::testing::Test {
 protected:
  void SetUp() override {
    auto store = store::Store::Open({.path = ":memory:"});
    ASSERT_TRUE(store.ok()) << store.status();
    store_ = *std::move(store);
    store::AddRobotWithSession(*store_);
  }

  // As a worker of a process that then ends.
  Claim ClaimAndDie() {
    const auto claim =
        store_->Write([](store::Transaction& transaction) { return ClaimNext(transaction); });
    EXPECT_TRUE(claim.ok() && claim->has_value()) << claim.status();
    return **claim;
  }
  void Recover() {
    ASSERT_TRUE(
        store_
            ->Write([](store::Transaction& transaction) { return RecoverRunning(transaction, 3); })
            .ok());
  }
  absl::StatusOr<bool> End(const Claim& claim) {
    Outcome outcome;
    outcome.kind = Outcome::Kind::kResult;
    outcome.calibration = store::SampleCalibration();
    return store_->Write(
        [&](store::Transaction& transaction) { return EndJob(transaction, claim, outcome); });
  }
  std::unique_ptr<JobEngine> StartEngine() {
    auto engine = std::make_unique<JobEngine>(*store_, runner_.AsRunner(), QuickOptions());
    EXPECT_TRUE(engine->Start().ok());
    return engine;
  }

  std::unique_ptr<store::Store> store_;
  HandRunner runner_;
};

// Catches a job that stays RUNNING for ever because nobody runs it.
TEST_F(Restart, ARunningJobIsTakenUpAgain) {
  const std::string name = store::AddJob(*store_, 1);
  ClaimAndDie();
  runner_.EndWith(store::SampleCalibration());
  const auto engine = StartEngine();
  const v1::CalibrationJob job = Finish(*engine, name);
  EXPECT_EQ(job.state(), v1::SUCCEEDED);
  EXPECT_EQ(job.attempts(), 2);
}

// Catches a job that ends every process that runs it, for ever.
TEST_F(Restart, AJobBegunThreeTimesWithoutAnEndFails) {
  const std::string name = store::AddJob(*store_, 1);
  for (int attempt = 1; attempt <= 3; ++attempt) {
    ClaimAndDie();
    EXPECT_EQ(Stored(*store_, name).attempts(), attempt);
    Recover();
    EXPECT_EQ(Stored(*store_, name).state(), attempt < 3 ? v1::PENDING : v1::FAILED);
  }
  EXPECT_THAT(Stored(*store_, name).error().message(), HasSubstr("begun 3 times"));
  EXPECT_TRUE(Stored(*store_, name).has_end_time());
}

// Catches a cancellation that a restart forgets.
TEST_F(Restart, ACancellationSurvives) {
  const std::string name = store::AddJob(*store_, 1);
  ClaimAndDie();
  ASSERT_TRUE(
      store_
          ->Write([&](store::Transaction& transaction) { return RequestCancel(transaction, name); })
          .ok());
  const auto engine = StartEngine();
  EXPECT_EQ(Finish(*engine, name).state(), v1::CANCELLED);
  EXPECT_TRUE(runner_.Inputs().empty());
}

// Catches a cancellation that comes between a worker's claim and its first look.
TEST_F(Restart, ACancellationWithoutItsWorkerIsSeenAtTheEnd) {
  const std::string name = store::AddJob(*store_, 1);
  const Claim claim = ClaimAndDie();
  ASSERT_TRUE(
      store_
          ->Write([&](store::Transaction& transaction) { return RequestCancel(transaction, name); })
          .ok());
  EXPECT_TRUE(*End(claim)) << "the lease is still held";
  EXPECT_EQ(Stored(*store_, name).state(), v1::CANCELLED);
  EXPECT_EQ(CalibrationCount(*store_), 0);
}

// A clock that does something when it is asked for the first time: between a worker's claim and its
// first look.
class ClockWithHook : public store::Clock {
 public:
  explicit ClockWithHook(std::function<void()> hook) : hook_(std::move(hook)) {}
  absl::Time Now() const override { return store::RealClock().Now(); }
  absl::Duration Monotonic() const override {
    std::call_once(once_, hook_);
    return store::RealClock().Monotonic();
  }

 private:
  const std::function<void()> hook_;
  mutable std::once_flag once_;
};

// Catches a run of ten minutes although its cancellation was there before it began.
TEST_F(Restart, ACancellationRightAfterTheClaimKeepsTheRunFromBeginning) {
  const std::string name = store::AddJob(*store_, 1);
  const ClockWithHook clock([&] {
    const auto asked = store_->Write(
        [&](store::Transaction& transaction) { return RequestCancel(transaction, name); });
    EXPECT_EQ(asked->state(), v1::RUNNING);
  });
  runner_.EndWith(store::SampleCalibration());
  JobEngine engine(*store_, runner_.AsRunner(), QuickOptions(), clock);
  ASSERT_TRUE(engine.Start().ok());
  EXPECT_EQ(Finish(engine, name).state(), v1::CANCELLED);
  EXPECT_TRUE(runner_.Inputs().empty());
}

// Catches a worker that ends a job which was taken from it: while it waits, while another runs it,
// after it ended.
TEST_F(Restart, ALostLeaseChangesNothing) {
  const std::string name = store::AddJob(*store_, 1);
  const Claim lost = ClaimAndDie();
  Recover();
  EXPECT_FALSE(*End(lost));
  EXPECT_EQ(Stored(*store_, name).state(), v1::PENDING);
  const Claim held = ClaimAndDie();
  EXPECT_FALSE(*End(lost));
  EXPECT_EQ(Stored(*store_, name).state(), v1::RUNNING);
  EXPECT_TRUE(*End(held));
  const std::string ended = Stored(*store_, name).SerializeAsString();
  EXPECT_FALSE(*End(held)) << "only once";
  EXPECT_FALSE(*End(lost));
  EXPECT_EQ(Stored(*store_, name).SerializeAsString(), ended);
  EXPECT_EQ(CalibrationCount(*store_), 1);
}

// The same through engines: the second takes the job while the first still runs it.
TEST_F(Restart, TwoEnginesMakeOneCalibration) {
  const std::string name = store::AddJob(*store_, 1);
  const auto first = StartEngine();
  ASSERT_TRUE(runner_.WaitForRuns(1));
  const auto second = StartEngine();
  ASSERT_TRUE(runner_.WaitForRuns(2));
  runner_.EndWith(store::SampleCalibration());
  EXPECT_EQ(Finish(*second, name).state(), v1::SUCCEEDED);
  first->Stop();
  second->Stop();
  EXPECT_EQ(CalibrationCount(*store_), 1);
  EXPECT_EQ(Stored(*store_, name).attempts(), 2);
}

// Catches a job that two workers claim, or that none does.
TEST_F(Restart, TwoEnginesShareTheQueue) {
  constexpr int kJobs = 40;
  runner_.EndWith(store::SampleCalibration());
  const auto first = StartEngine();
  const auto second = StartEngine();
  for (int number = 1; number <= kJobs; ++number) {
    store::AddJob(*store_, number);
    first->Wake();
    second->Wake();
  }
  for (int number = 1; number <= kJobs; ++number) {
    const std::string name = store::JobName(store::Uuid(number));
    // Either engine may have run it, and each tells its own watchers only.
    for (v1::CalibrationJob job = Stored(*store_, name); job.state() != v1::SUCCEEDED;
         job = Stored(*store_, name)) {
      std::this_thread::yield();
    }
    EXPECT_EQ(Stored(*store_, name).attempts(), 1);
  }
  EXPECT_EQ(runner_.Inputs().size(), size_t{kJobs});
  EXPECT_EQ(CalibrationCount(*store_), kJobs);
}

}  // namespace
}  // namespace truepose::jobs
