// Jobs, their frozen input, and calibrations.
#include "server/store/jobs.h"

#include "server/store/calibrations.h"
#include "server/store/names.h"
#include "server/store/robots.h"
#include "server/store/session_row.h"
#include "server/store/sessions.h"
#include "tests/store/conformance/conformance.h"

namespace truepose::store {
namespace {

auto Create(int number, const v1::CalibrationJob& job) {
  return [=](Transaction& transaction) { return CreateJob(transaction, Uuid(number), job); };
}

auto Get(int number) {
  return [=](Snapshot& snapshot) { return GetJob(snapshot, JobName(Uuid(number))); };
}

auto Insert(int job, const v1::Calibration& calibration) {
  return [=](Transaction& transaction) -> absl::StatusOr<v1::Calibration> {
    const auto stored = GetJob(transaction, JobName(Uuid(job)));
    return stored.ok() ? InsertCalibration(transaction, *stored, calibration) : stored.status();
  };
}

// Catches a job that starts in another state or with values that the client may not choose.
TEST_P(StoreConformance, AJobBeginsPending) {
  AddRobotWithSession(*store_);
  v1::CalibrationJob asked = SampleJob("ur10", {1});
  asked.set_state(v1::SUCCEEDED);
  asked.set_calibration("robots/ur10/calibrations/1");
  asked.set_attempts(7);
  const auto job = Write(Create(1, asked));
  ASSERT_TRUE(job.ok()) << job.status();
  EXPECT_EQ(job->name(), JobName(Uuid(1)));
  EXPECT_EQ(job->state(), v1::PENDING);
  EXPECT_EQ(job->calibration(), "");
  EXPECT_EQ(job->attempts(), 0);
  EXPECT_EQ(job->options().split(), "even-odd");
  EXPECT_EQ(job->create_time().seconds(), absl::ToUnixSeconds(clock_.Now()));
  EXPECT_EQ(Read(Get(1))->SerializeAsString(), job->SerializeAsString());
}

// Catches a retry that makes a second job, and other input that is taken for a retry.
TEST_P(StoreConformance, ARepeatedCreateOfAJob) {
  AddRobotWithSession(*store_);
  const auto first = Write(Create(1, SampleJob("ur10", {1})));
  EXPECT_EQ(Write(Create(1, SampleJob("ur10", {1})))->SerializeAsString(),
            first->SerializeAsString());
  v1::CalibrationJob other = SampleJob("ur10", {1});
  other.set_input_digest("other");
  EXPECT_EQ(Write(Create(1, other)).status().code(), absl::StatusCode::kAlreadyExists);
  EXPECT_EQ(Read([](Snapshot& snapshot) { return ListJobs(snapshot, "", {}); })->items.size(), 1u);
}

// Catches a job over what isn't fit for one, and faults that come one at a time.
TEST_P(StoreConformance, AllFaultsOfAJobAtOnce) {
  AddRobotWithSession(*store_);
  AddRobot(*store_, "panda");
  AddSession(*store_, 2, "ur10", 3);
  AddSealedSession(*store_, 3, "panda", 3);
  const auto result = Write(Create(1, SampleJob("ur10", {1, 2, 3, 4, 1})));
  EXPECT_EQ(result.status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(FaultFields(result.status()),
            (std::vector<std::string>{"sessions[1]", "sessions[2]", "sessions[3]", "sessions[4]"}));
  EXPECT_EQ(Write(Create(1, SampleJob("ur10", {}))).status().code(),
            absl::StatusCode::kInvalidArgument);
  v1::CalibrationJob crossed = SampleJob("ur10", {1});
  crossed.set_nominal_revision("robots/panda/nominals/1");
  EXPECT_EQ(FaultFields(Write(Create(1, crossed)).status()),
            std::vector<std::string>{"nominal_revision"});
  EXPECT_EQ(Read(Get(1)).status().code(), absl::StatusCode::kNotFound);
}

// Catches input that isn't what was frozen: a later revision of the robot, sessions out of order.
TEST_P(StoreConformance, TheInputOfAJobIsFrozen) {
  AddRobotWithSession(*store_);
  AddSealedSession(*store_, 2, "ur10", 6);
  const auto job = Write(Create(1, SampleJob("ur10", {2, 1})));
  ASSERT_TRUE(Write([](Transaction& transaction) {
                return AddNominalRevision(transaction, "robots/ur10", SampleNominal("new"), "new");
              }).ok());
  const auto input = Read([&](Snapshot& snapshot) { return LoadJobInput(snapshot, *job); });
  ASSERT_TRUE(input.ok()) << input.status();
  EXPECT_EQ(input->nominal().serial(), "ur10");
  EXPECT_EQ(input->nominal_revision(), "robots/ur10/nominals/1");
  EXPECT_EQ(input->options().split(), "even-odd");
  ASSERT_EQ(input->sessions_size(), 2);
  EXPECT_EQ(input->sessions(0).readings_size(), 6);
  EXPECT_EQ(input->sessions(1).session().name(), SessionName(Uuid(1)));
  EXPECT_EQ(input->sessions(1).readings(3).SerializeAsString(),
            SampleReading(3).SerializeAsString());
}

// Catches a job that runs on readings other than those it was created with.
TEST_P(StoreConformance, DamagedInputIsDataLoss) {
  AddRobotWithSession(*store_);
  const auto job = Write(Create(1, SampleJob("ur10", {1})));
  ASSERT_TRUE(Write([](Transaction& transaction) {
                return transaction.sql().Execute("DELETE FROM readings WHERE row_index = 3");
              }).ok());
  const auto input = Read([&](Snapshot& snapshot) { return LoadJobInput(snapshot, *job); });
  EXPECT_EQ(input.status().code(), absl::StatusCode::kDataLoss);
}

// The same for a session that was sealed as something else meanwhile.
TEST_P(StoreConformance, ASessionWithAnotherDigestIsDataLoss) {
  AddRobotWithSession(*store_);
  const auto job = Write(Create(1, SampleJob("ur10", {1})));
  ASSERT_TRUE(Write([](Transaction& transaction) -> absl::Status {
                v1::Session session = *GetSession(transaction, SessionName(Uuid(1)));
                session.set_digest("another");
                return UpdateSession(transaction, session);
              }).ok());
  const auto input = Read([&](Snapshot& snapshot) { return LoadJobInput(snapshot, *job); });
  EXPECT_EQ(input.status().code(), absl::StatusCode::kDataLoss);
}

// Catches states that a list of jobs doesn't show.
TEST_P(StoreConformance, JobsByState) {
  AddRobotWithSession(*store_);
  for (int number : {3, 1, 2}) AddJob(*store_, number);
  ASSERT_TRUE(Write([](Transaction& transaction) -> absl::Status {
                v1::CalibrationJob job = *GetJob(transaction, JobName(Uuid(3)));
                job.set_state(v1::RUNNING);
                return UpdateJob(transaction, job, transaction.revision());
              }).ok());
  EXPECT_EQ(*Read([](Snapshot& snapshot) { return JobsInState(snapshot, v1::RUNNING); }),
            std::vector<std::string>{JobName(Uuid(3))});
  EXPECT_EQ(*Read([](Snapshot& snapshot) { return GetLease(snapshot, JobName(Uuid(3))); }),
            Read(Get(3))->revision());
  const auto list = Read([](Snapshot& snapshot) {
    return ListJobs(snapshot, "robots/ur10", {.size = 2, .token = ""});
  });
  ASSERT_EQ(list->items.size(), 2u);
  EXPECT_EQ(list->items[0].name(), JobName(Uuid(2))) << "newest first";
  const auto rest = Read([&](Snapshot& snapshot) {
    return ListJobs(snapshot, "robots/ur10", {.size = 2, .token = list->next_page_token});
  });
  ASSERT_EQ(rest->items.size(), 1u);
  EXPECT_EQ(rest->items[0].state(), v1::RUNNING);
}

// Catches numbers that are shared between robots or given twice, and parts that get lost between
// the two blobs.
TEST_P(StoreConformance, CalibrationsAreNumberedPerRobot) {
  AddRobotWithSession(*store_);
  AddRobot(*store_, "panda");
  AddSealedSession(*store_, 2, "panda", 4);
  AddJob(*store_, 1);
  AddJob(*store_, 2);
  AddJob(*store_, 3, "panda", {2});
  EXPECT_EQ(Write(Insert(1, SampleCalibration()))->name(), "robots/ur10/calibrations/1");
  EXPECT_EQ(Write(Insert(3, SampleCalibration()))->name(), "robots/panda/calibrations/1");
  const auto second = Write(Insert(2, SampleCalibration()));
  ASSERT_TRUE(second.ok()) << second.status();
  EXPECT_EQ(second->name(), "robots/ur10/calibrations/2");
  EXPECT_EQ(second->job(), JobName(Uuid(2)));
  EXPECT_EQ(second->options().split(), "even-odd");
  const auto read = Read(
      [](Snapshot& snapshot) { return GetCalibration(snapshot, "robots/ur10/calibrations/2"); });
  EXPECT_EQ(read->SerializeAsString(), second->SerializeAsString());
  EXPECT_EQ(read->residuals_size(), 1);
  const auto again = Write(Insert(2, SampleCalibration()));
  EXPECT_EQ(again.status().code(), absl::StatusCode::kAlreadyExists) << "one result a job";
  EXPECT_EQ(FaultFields(again.status()), std::vector<std::string>{"job"});
}

// Catches lists that carry what is long, and that are not newest first.
TEST_P(StoreConformance, ListsOfCalibrationsLeaveOutWhatIsLong) {
  AddRobotWithSession(*store_);
  for (int number = 1; number <= 3; ++number) {
    AddJob(*store_, number);
    ASSERT_TRUE(Write(Insert(number, SampleCalibration())).ok());
  }
  const auto list = Read([](Snapshot& snapshot) {
    return ListCalibrations(snapshot, "robots/ur10", {.size = 2, .token = ""});
  });
  ASSERT_EQ(list->items.size(), 2u);
  EXPECT_EQ(list->items[0].name(), "robots/ur10/calibrations/3");
  EXPECT_EQ(list->items[0].report().model(), "modified_incremental");
  EXPECT_EQ(list->items[0].residuals_size(), 0);
  EXPECT_EQ(list->items[0].covariance_size(), 0);
  const auto unknown =
      Read([](Snapshot& snapshot) { return ListCalibrations(snapshot, "robots/none", {}); });
  EXPECT_EQ(unknown.status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(FaultFields(unknown.status()), std::vector<std::string>{"robot"});
  EXPECT_EQ(Read([](Snapshot& snapshot) {
              return GetCalibration(snapshot, "robots/ur10/calibrations/9");
            })
                .status()
                .code(),
            absl::StatusCode::kNotFound);
}

}  // namespace
}  // namespace truepose::store
