#include "server/jobs/engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "server/store/calibrations.h"
#include "server/store/jobs.h"
#include "server/store/names.h"
#include "tests/jobs/engine_testing.h"
#include "tests/store/testing/fake_clock.h"
#include "tests/store/testing/faulty_connection.h"
#include "tests/store/testing/samples.h"

namespace truepose::jobs {
namespace {

using ::testing::HasSubstr;

class Engine : public ::testing::Test {
 protected:
  void SetUp() override {
    auto store = store::Store::Open(
        {.path = ":memory:", .clock = &clock_, .decorate_writer = store::Faulty(plan_)});
    ASSERT_TRUE(store.ok()) << store.status();
    store_ = *std::move(store);
    store::AddRobotWithSession(*store_);
  }

  void Start(EngineOptions options = QuickOptions()) {
    StartWith(runner_.AsRunner(), std::move(options));
  }
  void StartWith(Runner runner, EngineOptions options = QuickOptions()) {
    engine_ = std::make_unique<JobEngine>(*store_, std::move(runner), std::move(options), clock_);
    ASSERT_TRUE(engine_->Start().ok());
  }
  std::string Add(int number) {
    const std::string name = store::AddJob(*store_, number);
    if (engine_ != nullptr) engine_->Wake();
    return name;
  }

  store::FakeClock clock_;
  std::shared_ptr<store::FaultPlan> plan_ = std::make_shared<store::FaultPlan>();
  std::unique_ptr<store::Store> store_;
  HandRunner runner_;  // outlives the engine
  std::unique_ptr<JobEngine> engine_;
};

// Catches a result that isn't the run's, an input that isn't the frozen one, times and counts that
// aren't kept.
TEST_F(Engine, ARunBecomesACalibration) {
  Start();
  const std::string name = Add(1);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  EXPECT_EQ(runner_.Inputs()[0].sessions(0).readings_size(), 4);
  EXPECT_EQ(runner_.Inputs()[0].nominal().serial(), "ur10");
  EXPECT_EQ(Stored(*store_, name).state(), v1::RUNNING);
  EXPECT_EQ(Stored(*store_, name).start_time().seconds(), absl::ToUnixSeconds(clock_.Now()));
  clock_.Advance(absl::Seconds(5));
  runner_.EndWith(store::SampleCalibration());
  const v1::CalibrationJob job = Finish(*engine_, name);
  EXPECT_EQ(job.state(), v1::SUCCEEDED);
  EXPECT_EQ(job.calibration(), "robots/ur10/calibrations/1");
  EXPECT_EQ(job.attempts(), 1);
  EXPECT_EQ(job.end_time().seconds(), absl::ToUnixSeconds(clock_.Now()));
  const auto calibration = store_->Read([](store::Snapshot& snapshot) {
    return store::GetCalibration(snapshot, "robots/ur10/calibrations/1");
  });
  EXPECT_EQ(calibration->digest(), store::SampleCalibration().digest());
  EXPECT_EQ(calibration->job(), name);
}

// Catches faults of the input that get lost on their way to the user.
TEST_F(Engine, AFailedRunTellsItsFaults) {
  Start();
  FaultList faults;
  faults.Add("sessions[0].readings[3].position_m", "NaN", "a number");
  faults.Add("options.split", "'odd'", "a split");
  runner_.EndWith(faults.ToStatus());
  const v1::CalibrationJob job = Finish(*engine_, Add(1));
  EXPECT_EQ(job.state(), v1::FAILED);
  EXPECT_EQ(job.error().code(), static_cast<int>(absl::StatusCode::kInvalidArgument));
  ASSERT_EQ(job.error().faults_size(), 2);
  EXPECT_EQ(job.error().faults(1).field(), "options.split");
  EXPECT_EQ(job.error().faults(1).found(), "'odd'");
  EXPECT_EQ(job.error().faults(1).expected(), "a split");
  EXPECT_EQ(job.calibration(), "");
  EXPECT_EQ(CalibrationCount(*store_), 0);
}

// Catches a run that takes the server with it.
TEST_F(Engine, AnExceptionFailsTheJobOnly) {
  bool first = true;
  StartWith(
      [&first](const v1::CalibrationInput&, const RunnerHooks&) -> absl::StatusOr<v1::Calibration> {
        if (std::exchange(first, false)) throw std::runtime_error("out of luck");
        return store::SampleCalibration();
      });
  const v1::CalibrationJob failed = Finish(*engine_, Add(1));
  EXPECT_EQ(failed.state(), v1::FAILED);
  EXPECT_THAT(failed.error().message(), HasSubstr("out of luck"));
  EXPECT_EQ(Finish(*engine_, Add(2)).state(), v1::SUCCEEDED);
}

// Catches a job that waits for its turn and runs although it was cancelled.
TEST_F(Engine, AWaitingJobIsCancelledAtOnce) {
  Start();
  const std::string running = Add(1);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  const std::string waiting = Add(2);
  const auto cancelled = engine_->Cancel(waiting);
  ASSERT_TRUE(cancelled.ok()) << cancelled.status();
  EXPECT_EQ(cancelled->state(), v1::CANCELLED);
  EXPECT_TRUE(cancelled->has_end_time());
  runner_.EndWith(store::SampleCalibration());
  EXPECT_EQ(Finish(*engine_, running).state(), v1::SUCCEEDED);
  EXPECT_EQ(Finish(*engine_, Add(3)).state(), v1::SUCCEEDED);
  EXPECT_EQ(runner_.Inputs().size(), 2u) << "the cancelled one never ran";
}

// Catches a run that isn't told.
TEST_F(Engine, ARunningJobIsAskedToEnd) {
  Start();
  const std::string name = Add(1);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  const auto asked = engine_->Cancel(name);
  ASSERT_TRUE(asked.ok()) << asked.status();
  EXPECT_EQ(asked->state(), v1::RUNNING);
  EXPECT_TRUE(asked->cancel_requested());
  EXPECT_EQ(Finish(*engine_, name).state(), v1::CANCELLED);
}

// Catches a calibration of a job whose cancellation was acknowledged.
TEST_F(Engine, AResultAfterTheCancellationIsDropped) {
  runner_.IgnoreCancellation();
  Start();
  const std::string name = Add(1);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  ASSERT_TRUE(engine_->Cancel(name).ok());
  runner_.EndWith(store::SampleCalibration());
  EXPECT_EQ(Finish(*engine_, name).state(), v1::CANCELLED);
  EXPECT_EQ(CalibrationCount(*store_), 0);
}

// Catches a cancellation that changes what has ended, or a second one that fails.
TEST_F(Engine, CancellingWhatHasEnded) {
  Start();
  runner_.EndWith(store::SampleCalibration());
  const v1::CalibrationJob succeeded = Finish(*engine_, Add(1));
  EXPECT_EQ(engine_->Cancel(succeeded.name()).status().code(),
            absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(Stored(*store_, succeeded.name()).SerializeAsString(), succeeded.SerializeAsString());
  EXPECT_EQ(engine_->Cancel(store::JobName(store::Uuid(9))).status().code(),
            absl::StatusCode::kNotFound);
  engine_->Stop();
  const std::string waiting = store::AddJob(*store_, 2);
  const auto once = engine_->Cancel(waiting);
  EXPECT_EQ(engine_->Cancel(waiting)->SerializeAsString(), once->SerializeAsString());
}

// Catches a late result that is stored, and a deadline that doesn't reach the run.
TEST_F(Engine, ALateJobFails) {
  Start();
  const std::string name = Add(1);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  clock_.Advance(absl::Minutes(11));
  const v1::CalibrationJob job = Finish(*engine_, name);
  EXPECT_EQ(job.state(), v1::FAILED);
  EXPECT_EQ(job.error().code(), static_cast<int>(absl::StatusCode::kDeadlineExceeded));
  EXPECT_THAT(job.error().message(), HasSubstr("10m"));
}

TEST_F(Engine, ALateResultIsDropped) {
  runner_.IgnoreCancellation();
  Start();
  const std::string name = Add(1);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  clock_.Advance(absl::Minutes(11));
  runner_.EndWith(store::SampleCalibration());
  EXPECT_EQ(Finish(*engine_, name).state(), v1::FAILED);
  EXPECT_EQ(CalibrationCount(*store_), 0);
}

// Catches a deadline by the wall clock, which somebody may set.
TEST_F(Engine, TheWallClockEndsNoJob) {
  Start();
  const std::string name = Add(1);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  clock_.JumpWall(absl::Hours(48));
  runner_.EndWith(store::SampleCalibration());
  EXPECT_EQ(Finish(*engine_, name).state(), v1::SUCCEEDED);
}

// Catches a queue out of order, and workers that don't work at once.
TEST_F(Engine, OldestFirstAndAsManyAtOnceAsThereAreWorkers) {
  for (int number : {4, 2, 3}) {
    const std::string robot = absl::StrCat("robot-", number);
    store::AddRobot(*store_, robot);
    store::AddSealedSession(*store_, number, robot, number);
    store::AddJob(*store_, number, robot, {number});
  }
  EngineOptions options = QuickOptions();
  options.workers = 2;
  Start(options);
  ASSERT_TRUE(runner_.WaitForRuns(2));
  EXPECT_EQ(Stored(*store_, store::JobName(store::Uuid(3))).state(), v1::PENDING);
  runner_.EndWith(store::SampleCalibration());
  EXPECT_EQ(Finish(*engine_, store::JobName(store::Uuid(3))).state(), v1::SUCCEEDED);
  const auto inputs = runner_.Inputs();
  EXPECT_EQ(inputs[0].sessions(0).readings_size() + inputs[1].sessions(0).readings_size(), 4 + 2);
  EXPECT_EQ(inputs[2].sessions(0).readings_size(), 3);
}

// Catches a stop that loses the job, counts the attempt, or waits for the run.
TEST_F(Engine, AStopPutsRunningJobsBack) {
  Start();
  const std::string name = Add(1);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  engine_->Stop();
  const v1::CalibrationJob stopped = Stored(*store_, name);
  EXPECT_EQ(stopped.state(), v1::PENDING);
  EXPECT_EQ(stopped.attempts(), 0);
  EXPECT_FALSE(stopped.has_start_time());
  runner_.EndWith(store::SampleCalibration());
  Start();
  const v1::CalibrationJob finished = Finish(*engine_, name);
  EXPECT_EQ(finished.state(), v1::SUCCEEDED);
  EXPECT_EQ(finished.attempts(), 1);
}

// Catches a result that is given up because the disk was full for a moment.
TEST_F(Engine, AnEndThatCannotBeStoredIsTriedAgain) {
  std::mutex mutex;
  std::vector<std::string> warnings;
  EngineOptions options = QuickOptions();
  options.on_warning = [&](const std::string& warning) {
    const std::lock_guard lock(mutex);
    warnings.push_back(warning);
  };
  Start(options);
  const std::string name = Add(1);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  plan_->only = "COMMIT";
  plan_->statements = 0;
  plan_->fault = [] { return absl::ResourceExhaustedError("disk full"); };
  plan_->fault_at = 1;
  runner_.EndWith(store::SampleCalibration());
  EXPECT_EQ(Finish(*engine_, name).state(), v1::SUCCEEDED);
  EXPECT_EQ(CalibrationCount(*store_), 1);
  const std::lock_guard lock(mutex);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("disk full"));
}

// Catches a job that runs for ever because its result can never be stored.
TEST_F(Engine, AResultThatCanNeverBeStoredFailsTheJob) {
  Start();
  const std::string name = Add(1);
  ASSERT_TRUE(runner_.WaitForRuns(1));
  plan_->only = "INSERT INTO calibrations";
  plan_->statements = 0;
  plan_->fault = [] { return absl::InternalError("too long for a row"); };
  plan_->fault_at = 1;
  runner_.EndWith(store::SampleCalibration());
  const v1::CalibrationJob job = Finish(*engine_, name);
  EXPECT_EQ(job.state(), v1::FAILED);
  EXPECT_THAT(job.error().message(), HasSubstr("too long for a row"));
}

// Catches a job on other readings than it was created with.
TEST_F(Engine, DamagedInputFailsTheJob) {
  const std::string name = store::AddJob(*store_, 1);
  ASSERT_TRUE(store_
                  ->Write([](store::Transaction& transaction) {
                    return transaction.sql().Execute("DELETE FROM readings");
                  })
                  .ok());
  Start();
  const v1::CalibrationJob job = Finish(*engine_, name);
  EXPECT_EQ(job.state(), v1::FAILED);
  EXPECT_EQ(job.error().code(), static_cast<int>(absl::StatusCode::kDataLoss));
  EXPECT_TRUE(runner_.Inputs().empty());
}

// Catches options that are checked one at a time, and an engine that starts with them, twice, or on
// a failing store.
TEST_F(Engine, AStartThatIsRefused) {
  EngineOptions options;
  options.workers = 0;
  options.max_attempts = 0;
  options.deadline = absl::ZeroDuration();
  options.lease = absl::ZeroDuration();
  options.sweep = absl::ZeroDuration();
  options.store_retry = absl::ZeroDuration();
  JobEngine wrong(*store_, runner_.AsRunner(), options, clock_);
  const absl::Status status = wrong.Start();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(store::FaultFields(status),
            (std::vector<std::string>{"workers", "deadline", "max_attempts", "lease", "sweep",
                                      "store_retry"}));

  store::AddJob(*store_, 1);
  JobEngine unlucky(*store_, runner_.AsRunner(), QuickOptions(), clock_);
  plan_->statements = 0;
  plan_->fault_at = 1;
  EXPECT_EQ(unlucky.Start().code(), absl::StatusCode::kUnavailable);
  unlucky.Stop();
  EXPECT_TRUE(runner_.Inputs().empty());

  Start();
  EXPECT_EQ(engine_->Start().code(), absl::StatusCode::kFailedPrecondition);
}

}  // namespace
}  // namespace truepose::jobs
