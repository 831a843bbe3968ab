// EngineOptions::on_end: what waits for a job hears of its end in the commit that ends it, whoever
// ends it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>
#include <set>

#include "absl/strings/str_cat.h"
#include "server/jobs/engine.h"
#include "server/jobs/transitions.h"
#include "server/store/jobs.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "tests/jobs/engine_testing.h"
#include "tests/store/testing/fake_clock.h"
#include "tests/store/testing/samples.h"

namespace truepose::jobs {
namespace {

using Told = std::pair<std::string, v1::JobState>;

class JobEnd : public ::testing::Test {
 protected:
  void SetUp() override {
    auto store = store::Store::Open({.path = ":memory:", .clock = &clock_});
    ASSERT_TRUE(store.ok()) << store.status();
    store_ = *std::move(store);
    store::AddRobotWithSession(*store_);
  }

  void Start(EngineOptions options = QuickOptions()) {
    options.on_end = [this](store::Transaction& transaction, const v1::CalibrationJob& job) {
      // The transaction's own state is the one that is told.
      EXPECT_EQ(store::GetJob(transaction, job.name())->state(), job.state());
      const std::lock_guard lock(mutex_);
      told_.insert({job.name(), job.state()});
      return absl::OkStatus();
    };
    engine_ = std::make_unique<JobEngine>(*store_, runner_.AsRunner(), std::move(options), clock_);
    ASSERT_TRUE(engine_->Start().ok());
  }

  std::string Add(int number, absl::Duration until_deadline = absl::InfiniteDuration()) {
    v1::CalibrationJob job = store::SampleJob("ur10", {1});
    if (until_deadline != absl::InfiniteDuration())
      *job.mutable_deadline() = store::ToTimestamp(clock_.Now() + until_deadline);
    EXPECT_TRUE(store_
                    ->Write([&](store::Transaction& transaction) {
                      return store::CreateJob(transaction, store::Uuid(number), job);
                    })
                    .ok());
    if (engine_ != nullptr) engine_->Wake();
    return store::JobName(store::Uuid(number));
  }

  std::set<Told> AllTold() {
    const std::lock_guard lock(mutex_);
    return told_;
  }

  store::FakeClock clock_;
  std::unique_ptr<store::Store> store_;
  HandRunner runner_;  // outlives the engine
  std::mutex mutex_;
  std::set<Told> told_;
  std::unique_ptr<JobEngine> engine_;
};

// Catches an end by the worker, by Cancel or by the sweeper that is not told, and a beginning that
// is.
TEST_F(JobEnd, IsToldOnceAJobHasEnded) {
  Start();
  const std::string runs = Add(1);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  const std::string cancelled = Add(2);
  const std::string late = Add(3, absl::Seconds(5));
  EXPECT_TRUE(AllTold().empty());
  ASSERT_TRUE(engine_->Cancel(cancelled).ok());
  EXPECT_EQ(AllTold(), (std::set<Told>{{cancelled, v1::CANCELLED}}));
  clock_.Advance(absl::Seconds(5));
  Finish(*engine_, late);
  runner_.EndWith(store::SampleCalibration());
  Finish(*engine_, runs);
  EXPECT_EQ(AllTold(), (std::set<Told>{
                           {cancelled, v1::CANCELLED}, {late, v1::FAILED}, {runs, v1::SUCCEEDED}}));
}

// Catches a run that failed and isn't told.
TEST_F(JobEnd, AFailedRunIsTold) {
  runner_.EndWith(absl::InvalidArgumentError("too few rows"));
  Start();
  const std::string name = Add(1);
  Finish(*engine_, name);
  EXPECT_EQ(AllTold(), (std::set<Told>{{name, v1::FAILED}}));
}

// Catches a job that is given up after its third silent worker, or by the next process, and isn't
// told.
TEST_F(JobEnd, GivingUpIsTold) {
  EngineOptions options = QuickOptions();
  options.lease = absl::Minutes(2);
  options.deadline = absl::Hours(10);
  options.max_attempts = 1;
  const std::string left = Add(1);
  ASSERT_TRUE(
      store_->Write([](store::Transaction& transaction) { return ClaimNext(transaction); }).ok());
  runner_.FallSilent();
  Start(options);
  EXPECT_EQ(AllTold(), (std::set<Told>{{left, v1::FAILED}}));
  const std::string silent = Add(2);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  clock_.Advance(absl::Minutes(3));
  Finish(*engine_, silent);
  EXPECT_EQ(AllTold(), (std::set<Told>{{left, v1::FAILED}, {silent, v1::FAILED}}));
  runner_.EndWith(store::SampleCalibration());
}

}  // namespace
}  // namespace truepose::jobs
