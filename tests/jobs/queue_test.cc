// Order, robots side by side, deadlines and lost leases, through the engine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

using ::testing::HasSubstr;

class Queue : public ::testing::Test {
 protected:
  void SetUp() override {
    auto store = store::Store::Open({.path = ":memory:", .clock = &clock_});
    ASSERT_TRUE(store.ok()) << store.status();
    store_ = *std::move(store);
    for (int robot : {1, 2, 3}) {
      store::AddRobot(*store_, absl::StrCat("r", robot));
      // So many rows that an input tells its robot.
      store::AddSealedSession(*store_, robot, absl::StrCat("r", robot), robot);
    }
  }
  void Start(EngineOptions options = QuickOptions()) {
    engine_ = std::make_unique<JobEngine>(*store_, runner_.AsRunner(), std::move(options), clock_);
    ASSERT_TRUE(engine_->Start().ok());
  }
  std::string Add(int number, int robot, int priority = 0,
                  absl::Duration until_deadline = absl::InfiniteDuration()) {
    v1::CalibrationJob job = store::SampleJob(absl::StrCat("r", robot), {robot});
    job.set_priority(priority);
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
  // The robots of the runs so far, in the order of their begin.
  std::vector<int> Robots() {
    std::vector<int> robots;
    for (const v1::CalibrationInput& input : runner_.Inputs())
      robots.push_back(input.sessions(0).readings_size());
    return robots;
  }

  store::FakeClock clock_;
  std::unique_ptr<store::Store> store_;
  HandRunner runner_;  // outlives the engine
  std::unique_ptr<JobEngine> engine_;
};

// Catches a queue that knows no priority.
TEST_F(Queue, TheHighestPriorityRunsFirst) {
  Add(1, 1);
  Add(2, 2, -5);
  Add(3, 3, 5);
  runner_.EndWith(store::SampleCalibration());
  Start();
  for (int number : {1, 2, 3}) Finish(*engine_, store::JobName(store::Uuid(number)));
  EXPECT_EQ(Robots(), (std::vector<int>{3, 1, 2}));
}

// Catches two jobs of one robot at once, a robot that waits for another's, and a second job that
// nobody takes up when the first one ends.
TEST_F(Queue, OneJobARobotWhileOthersRun) {
  EngineOptions options = QuickOptions();
  options.workers = 3;
  Add(1, 1, 2);
  const std::string second = Add(2, 1, 1);
  Add(3, 2);
  Start(options);
  ASSERT_TRUE(runner_.WaitForRuns(2));
  Add(4, 3);
  ASSERT_TRUE(runner_.WaitForRuns(3)) << "a worker is still free";
  EXPECT_EQ(Stored(*store_, second).state(), v1::PENDING);
  EXPECT_THAT(Robots(), ::testing::UnorderedElementsAre(1, 2, 3));
  runner_.EndWith(store::SampleCalibration());
  EXPECT_EQ(Finish(*engine_, second).state(), v1::SUCCEEDED);
}

// Catches a deadline that only a worker would notice: all of them are busy, and the watcher is
// told.
TEST_F(Queue, AWaitingJobFailsAtItsDeadline) {
  Start();
  Add(1, 1);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  const std::string waiting = Add(2, 2, 0, absl::Seconds(5));
  clock_.Advance(absl::Seconds(5));
  const v1::CalibrationJob job = Finish(*engine_, waiting);
  EXPECT_EQ(job.state(), v1::FAILED);
  EXPECT_EQ(job.error().code(), static_cast<int>(absl::StatusCode::kDeadlineExceeded));
  EXPECT_THAT(job.error().message(), HasSubstr("passed before it began"));
  EXPECT_TRUE(job.has_end_time());
  EXPECT_EQ(job.attempts(), 0);
}

// Catches a deadline that doesn't reach a run, or a result that is stored after it.
TEST_F(Queue, ARunningJobFailsAtItsDeadline) {
  runner_.IgnoreCancellation();
  Start();
  const std::string name = Add(1, 1, 0, absl::Seconds(5));
  ASSERT_TRUE(runner_.WaitForRuns(1));
  clock_.Advance(absl::Seconds(5));
  runner_.EndWith(store::SampleCalibration());
  const v1::CalibrationJob job = Finish(*engine_, name);
  EXPECT_EQ(job.state(), v1::FAILED);
  EXPECT_THAT(job.error().message(), HasSubstr("passed before it ended"));
  EXPECT_EQ(job.calibration(), "");
}

// Catches a deadline that a restart forgets: of a job that waited, and of one that ran.
TEST_F(Queue, DeadlinesHoldAfterARestart) {
  const std::string waited = Add(1, 1, 0, absl::Hours(2));
  const std::string ran = Add(2, 2, 9, absl::Hours(1));
  ASSERT_TRUE(
      store_->Write([](store::Transaction& transaction) { return ClaimNext(transaction); }).ok());
  ASSERT_EQ(Stored(*store_, ran).state(), v1::RUNNING);
  clock_.Advance(absl::Hours(3));
  Start();
  EXPECT_EQ(Finish(*engine_, ran).state(), v1::FAILED);
  EXPECT_EQ(Finish(*engine_, waited).state(), v1::FAILED);
  EXPECT_TRUE(runner_.Inputs().empty());
}

class Lease : public Queue {
 protected:
  static EngineOptions Options() {
    EngineOptions options = QuickOptions();
    options.lease = absl::Minutes(2);
    options.deadline = absl::Hours(10);
    return options;
  }
};

// Catches a worker that hangs and holds up its job and the queue for ever: another thread takes its
// place, and what it brings in the end changes nothing.
TEST_F(Lease, ASilentWorkerLosesItsJob) {
  runner_.FallSilent();
  Start(Options());
  const std::string name = Add(1, 1);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  clock_.Advance(absl::Minutes(3));
  ASSERT_TRUE(runner_.WaitForRuns(2)) << "the job is begun again, by a second thread";
  EXPECT_EQ(Stored(*store_, name).attempts(), 2);
  runner_.EndWith(store::SampleCalibration());
  EXPECT_EQ(Finish(*engine_, name).state(), v1::SUCCEEDED);
  const std::string next = Add(2, 1);
  EXPECT_EQ(Finish(*engine_, next).state(), v1::SUCCEEDED);
  EXPECT_EQ(Stored(*store_, name).attempts(), 2);
  EXPECT_EQ(Stored(*store_, name).calibration(), "robots/r1/calibrations/1");
}

// Catches a job that is tried for ever, and a failure without its reason.
TEST_F(Lease, AJobThatSilencesThreeWorkersFails) {
  runner_.FallSilent();
  Start(Options());
  const std::string name = Add(1, 1);
  for (int run = 1; run <= 3; ++run) {
    ASSERT_TRUE(runner_.WaitForRuns(run));
    // The worker's beat at its begin comes before the run does.
    clock_.Advance(absl::Minutes(3));
  }
  const v1::CalibrationJob job = Finish(*engine_, name);
  EXPECT_EQ(job.state(), v1::FAILED);
  EXPECT_EQ(job.attempts(), 3);
  EXPECT_THAT(job.error().message(), HasSubstr("begun 3 times"));
  EXPECT_THAT(job.error().message(), HasSubstr("no sign of life for 2m"));
  runner_.EndWith(store::SampleCalibration());
  EXPECT_EQ(Finish(*engine_, Add(2, 2)).state(), v1::SUCCEEDED) << "the queue goes on";
}

// Catches a lease that isn't renewed although the run calls its hooks.
TEST_F(Lease, AWorkerThatLivesKeepsItsJob) {
  Start(Options());
  const std::string name = Add(1, 1);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  Watching watching(*engine_, name);
  for (int minute = 1; minute <= 5; ++minute) {
    clock_.Advance(absl::Minutes(1));
    // The report is a sign of life after the turn of the clock.
    runner_.Report(0.1 * minute);
    ASSERT_TRUE(watching.WaitFor(
        [&](const v1::CalibrationJob& job) { return job.progress().fraction() == 0.1 * minute; }));
  }
  // 5 minutes for one half: as long again. Between the report and its watcher the clock stands.
  EXPECT_DOUBLE_EQ(engine_->Get(name)->progress().seconds_left(), 300);
  runner_.EndWith(store::SampleCalibration());
  const v1::CalibrationJob job = Finish(*engine_, name);
  EXPECT_EQ(job.state(), v1::SUCCEEDED);
  EXPECT_EQ(job.attempts(), 1);
}

}  // namespace
}  // namespace truepose::jobs
