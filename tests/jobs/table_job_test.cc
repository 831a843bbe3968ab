// Jobs that build compensation tables, through the engine.
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "server/jobs/engine.h"
#include "server/store/checksum.h"
#include "server/store/compensation_tables.h"
#include "server/store/files.h"
#include "server/store/names.h"
#include "tests/jobs/engine_testing.h"
#include "tests/store/testing/samples.h"

namespace truepose::jobs {
namespace {

constexpr char kBytes[] = "the bytes of a table";

class TableJob : public ::testing::Test {
 protected:
  void SetUp() override {
    auto store = store::Store::Open({.path = ":memory:"});
    ASSERT_TRUE(store.ok()) << store.status();
    store_ = *std::move(store);
    store::AddRobotWithSession(*store_);
    calibration_ = store::AddCalibration(*store_, 9);
    table_ = store::AddTableJob(*store_, 1, calibration_);
  }

  void Start(TableBuilder build, EngineOptions options = QuickOptions()) {
    engine_ = std::make_unique<JobEngine>(*store_, Runners(runner_.AsRunner(), build, {}),
                                          std::move(options));
    ASSERT_TRUE(engine_->Start().ok());
  }

  v1::CompensationTable Table() const {
    const auto table =
        store_->Read([&](store::Snapshot& snapshot) { return store::GetTable(snapshot, table_); });
    EXPECT_TRUE(table.ok()) << table.status();
    return table.value_or(v1::CompensationTable());
  }

  // What builds a file from nothing but its input.
  static absl::StatusOr<BuiltTable> Build(const v1::CompensationTableInput& input,
                                          const RunnerHooks&) {
    BuiltTable built{kBytes, {}};
    built.header.set_robot(input.robot());
    built.header.set_calibration(input.calibration().name());
    return built;
  }

  std::unique_ptr<store::Store> store_;
  std::string calibration_, table_;
  const std::string job_ = store::JobName(store::Uuid(1));
  HandRunner runner_;  // outlives the engine
  std::unique_ptr<JobEngine> engine_;
};

// Would catch a table that is READY in another commit than its job, a file of other bytes than its
// digest says, and a job that does not say what it built.
TEST_F(TableJob, IsReadyInTheCommitOfItsJob) {
  Start(Build);
  const v1::CalibrationJob job = Finish(*engine_, job_);
  ASSERT_EQ(job.state(), v1::SUCCEEDED) << job.DebugString();
  EXPECT_EQ(job.calibration(), calibration_);
  EXPECT_EQ(job.compensation_table(), table_);
  const v1::CompensationTable table = Table();
  EXPECT_EQ(table.state(), v1::TABLE_READY);
  EXPECT_EQ(table.revision(), job.revision());
  EXPECT_EQ(table.sha256(), store::Sha256Hex(kBytes));
  EXPECT_EQ(table.size_bytes(), static_cast<int64_t>(sizeof(kBytes) - 1));
  EXPECT_EQ(table.header().calibration(), calibration_);
  EXPECT_EQ(*store_->Read([&](store::Snapshot& snapshot) {
    return store::ReadPiece(snapshot, table.sha256(), 0);
  }),
            kBytes);
  EXPECT_EQ(CalibrationCount(*store_), 1) << "no calibration comes of it";
  EXPECT_TRUE(runner_.Inputs().empty()) << "nothing was calibrated";
}

// Would catch a builder that is given something else than what was frozen.
TEST_F(TableJob, IsGivenWholeCalibrationNominalAndSpec) {
  v1::CompensationTableInput seen;
  Start([&](const v1::CompensationTableInput& input, const RunnerHooks& hooks) {
    seen = input;
    return Build(input, hooks);
  });
  Finish(*engine_, job_);
  engine_->Stop();
  EXPECT_EQ(seen.robot(), "robots/ur10");
  EXPECT_EQ(seen.calibration().name(), calibration_);
  EXPECT_EQ(seen.calibration().covariance_size(), 1) << "with its detail";
  EXPECT_EQ(seen.nominal().SerializeAsString(), store::SampleNominal("ur10").SerializeAsString());
  EXPECT_EQ(seen.spec().seed(), 1u);
}

// Would catch a release that is decided by a table, whose job has no calibration of its own.
TEST_F(TableJob, IsNoResultToRelease) {
  std::atomic<int> results = 0, ends = 0;
  EngineOptions options = QuickOptions();
  options.with_result = [&](store::Transaction&, const v1::Calibration&) {
    ++results;
    return absl::OkStatus();
  };
  options.on_end = [&](store::Transaction&, const v1::CalibrationJob&) {
    ++ends;
    return absl::OkStatus();
  };
  Start(Build, options);
  Finish(*engine_, job_);
  EXPECT_EQ(results, 0);
  EXPECT_EQ(ends, 1);
}

// Would catch a build that can't be stopped, or leaves its file behind when it was.
TEST_F(TableJob, EndsWhenItIsCancelled) {
  std::atomic<bool> began = false;
  Start([&](const v1::CompensationTableInput&,
            const RunnerHooks& hooks) -> absl::StatusOr<BuiltTable> {
    began = true;
    began.notify_all();
    while (!hooks.is_cancelled()) std::this_thread::yield();
    return BuiltTable{kBytes, {}};  // too late
  });
  began.wait(false);
  ASSERT_TRUE(engine_->Cancel(job_).ok());
  EXPECT_EQ(Finish(*engine_, job_).state(), v1::CANCELLED);
  EXPECT_EQ(Table().sha256(), "");
  EXPECT_TRUE(absl::IsNotFound(store_
                                   ->Read([&](store::Snapshot& snapshot) {
                                     return store::ReadPiece(snapshot, store::Sha256Hex(kBytes), 0);
                                   })
                                   .status()));
}

// Would catch a build without memory that takes the server down, and a server without a builder
// whose jobs wait for ever.
TEST_F(TableJob, FailsWithTheReason) {
  Start([](const v1::CompensationTableInput&, const RunnerHooks&) -> absl::StatusOr<BuiltTable> {
    throw std::runtime_error("no memory");
  });
  const v1::CalibrationJob job = Finish(*engine_, job_);
  EXPECT_EQ(job.state(), v1::FAILED);
  EXPECT_EQ(job.error().message(), "the run ended with an exception: no memory");
  store::AddTableJob(*store_, 2, calibration_);
  Start({});
  const v1::CalibrationJob second = Finish(*engine_, store::JobName(store::Uuid(2)));
  EXPECT_EQ(second.state(), v1::FAILED);
  EXPECT_EQ(second.error().code(), static_cast<int>(absl::StatusCode::kUnimplemented));
}

}  // namespace
}  // namespace truepose::jobs
