// Jobs with the real runner: the same bits each time, and an end soon after the wish to end.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "absl/time/clock.h"
#include "convert/run.h"
#include "server/calibration_runner.h"
#include "server/jobs/engine.h"
#include "server/store/calibrations.h"
#include "server/store/jobs.h"
#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/robots.h"
#include "server/store/sessions.h"
#include "tests/jobs/engine_testing.h"
#include "tests/server/testing/examples.h"
#include "tests/store/testing/samples.h"

namespace truepose::jobs {
namespace {

class CalibrationJob : public ::testing::Test {
 protected:
  // robots/ur10 with a sealed session of so many poses.
  void Open(int poses) {
    auto store = store::Store::Open({.path = ":memory:"});
    ASSERT_TRUE(store.ok()) << store.status();
    store_ = *std::move(store);
    const v1::SessionInput session = truepose::testing::SimulatedSession(poses, 1);
    ASSERT_TRUE(store_
                    ->Write([](store::Transaction& transaction) {
                      return store::CreateRobot(transaction, "ur10", truepose::testing::SixAxes(),
                                                "digest");
                    })
                    .ok());
    store::AddSession(*store_, 1, "ur10", 0);
    const std::string name = store::SessionName(store::Uuid(1));
    ASSERT_TRUE(store_
                    ->Write([&](store::Transaction& transaction) -> absl::Status {
                      const auto appended = store::AppendReadings(
                          transaction, name, store::ReadingBatch(session.readings()));
                      if (!appended.ok()) return appended.status();
                      return store::SealSession(transaction, name, poses, "readings").status();
                    })
                    .ok());
  }
  void StartWith(Runner runner) {
    engine_ = std::make_unique<JobEngine>(*store_, std::move(runner), EngineOptions());
    ASSERT_TRUE(engine_->Start().ok());
  }
  std::string Add(int number, const std::string& split, const std::string& estimator = "") {
    v1::CalibrationJob job = store::SampleJob("ur10", {1});
    job.mutable_options()->set_split(split);
    job.mutable_options()->set_estimator(estimator);
    job.set_input_digest(split + estimator);
    EXPECT_TRUE(store_
                    ->Write([&](store::Transaction& transaction) {
                      return store::CreateJob(transaction, store::Uuid(number), job);
                    })
                    .ok());
    if (engine_ != nullptr) engine_->Wake();
    return store::JobName(store::Uuid(number));
  }
  v1::Calibration ResultOf(const v1::CalibrationJob& job) {
    const auto calibration = store_->Read([&](store::Snapshot& snapshot) {
      return store::GetCalibration(snapshot, job.calibration());
    });
    EXPECT_TRUE(calibration.ok()) << calibration.status();
    return calibration.value_or(v1::Calibration());
  }

  std::unique_ptr<store::Store> store_;
  std::unique_ptr<JobEngine> engine_;
};

// The parts that a run finds, as bytes.
std::string Bits(v1::Calibration calibration) {
  calibration.clear_provenance();
  calibration.clear_name();
  calibration.clear_job();
  calibration.clear_create_time();
  calibration.clear_created_by();
  calibration.clear_state();
  calibration.clear_release_steps();
  calibration.clear_revision();
  calibration.clear_etag();
  return calibration.SerializeAsString();
}

// Catches a result that depends on the run: on an address, an order, memory that nobody set.
TEST_F(CalibrationJob, TheSameInputGivesTheSameBits) {
  Open(60);
  StartWith(server::CalibrationRunner());
  const v1::CalibrationJob job = Finish(*engine_, Add(1, "even-odd"));
  ASSERT_EQ(job.state(), v1::SUCCEEDED) << job.error().message();
  const v1::Calibration first = ResultOf(job);
  ASSERT_GT(first.covariance_size(), 100);
  for (int run = 0; run < 2; ++run) {
    const auto input =
        store_->Read([&](store::Snapshot& snapshot) { return store::LoadJobInput(snapshot, job); });
    ASSERT_TRUE(input.ok()) << input.status();
    const auto again = server::CalibrationRunner()(
        *input, {.on_progress = [](const auto&) {}, .is_cancelled = [] { return false; }});
    ASSERT_TRUE(again.ok()) << again.status();
    EXPECT_EQ(again->digest(), first.digest());
    EXPECT_TRUE(std::equal(again->covariance().begin(), again->covariance().end(),
                           first.covariance().begin(), first.covariance().end()));
    EXPECT_EQ(Bits(*again), Bits(first));
  }
}

// Catches a second calibration of what there is, and one that is taken for another.
TEST_F(CalibrationJob, EqualContentIsTheCalibrationThereIs) {
  Open(60);
  StartWith(server::CalibrationRunner());
  const v1::CalibrationJob first = Finish(*engine_, Add(1, "even-odd"));
  const v1::CalibrationJob second = Finish(*engine_, Add(2, "even-odd"));
  EXPECT_EQ(second.state(), v1::SUCCEEDED);
  EXPECT_EQ(second.calibration(), first.calibration());
  EXPECT_EQ(ResultOf(second).job(), first.name());
  EXPECT_EQ(Finish(*engine_, Add(3, "every:3")).calibration(), "robots/ur10/calibrations/2");
  EXPECT_EQ(CalibrationCount(*store_), 2);
}

// Runs that are cancelled at their first report of a stage; the times of their hook calls.
struct CancelAt {
  std::string stage;
  JobEngine* engine = nullptr;
  std::string job = {};
  absl::Time last = absl::InfiniteFuture();
  absl::Duration longest = absl::ZeroDuration();  // between two calls, before the cancellation
  absl::Time cancelled = absl::InfiniteFuture();

  void Called() {
    const absl::Time now = absl::Now();
    if (now < cancelled && last < now) longest = std::max(longest, now - last);
    last = now;
  }

  Runner AsRunner() {
    return [this](const v1::CalibrationInput& input, const RunnerHooks& hooks) {
      return server::CalibrationRunner()(
          input, {.on_progress =
                      [&](const v1::JobProgress& progress) {
                        Called();
                        hooks.on_progress(progress);
                        const bool first = cancelled == absl::InfiniteFuture();
                        if (first && progress.stage() == stage && progress.iteration() > 0) {
                          EXPECT_TRUE(engine->Cancel(job).ok());
                          cancelled = absl::Now();
                        }
                      },
                  .is_cancelled =
                      [&] {
                        Called();
                        return hooks.is_cancelled();
                      }});
    };
  }
};

// Catches work that goes on for long without asking whether it should. 0.5 s is what a person waits
// for a button; an iteration is the longest time between two calls of the hooks until then.
TEST_F(CalibrationJob, EndsWithinAnIterationAndHalfASecond) {
  Open(4000);
  for (const char* estimator : {"levenberg_marquardt", "simplex"}) {
    for (const char* stage : {"start_values", "identification"}) {
      CancelAt cancel{.stage = stage};
      StartWith(cancel.AsRunner());
      cancel.engine = engine_.get();
      static int number = 0;
      cancel.job = store::JobName(store::Uuid(++number));
      const v1::CalibrationJob job = Finish(*engine_, Add(number, "even-odd", estimator));
      const absl::Duration took = absl::Now() - cancel.cancelled;
      EXPECT_EQ(job.state(), v1::CANCELLED) << estimator << " at " << stage;
      EXPECT_LE(took, cancel.longest + absl::Milliseconds(500)) << estimator << " at " << stage;
      RecordProperty(std::string(estimator) + "_" + stage + "_ms",
                     static_cast<int>(absl::ToInt64Milliseconds(took)));
      RecordProperty(std::string(estimator) + "_" + stage + "_longest_iteration_ms",
                     static_cast<int>(absl::ToInt64Milliseconds(cancel.longest)));
      engine_ = nullptr;
    }
  }
}

}  // namespace
}  // namespace truepose::jobs
