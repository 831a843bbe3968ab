// Whose turn it is, what an order of a job may say, and results of equal content.
#include "absl/strings/str_cat.h"
#include "server/store/calibrations.h"
#include "server/store/jobs.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "tests/store/conformance/conformance.h"

namespace truepose::store {
namespace {

// A robot with the sealed session of this number.
void AddRobotAndSession(Store& store, const std::string& robot_id, int session) {
  AddRobot(store, robot_id);
  AddSealedSession(store, session, robot_id, 2);
}

class Queue : public StoreConformance {
 protected:
  absl::StatusOr<v1::CalibrationJob> Create(int number, const v1::CalibrationJob& job) {
    return Write(
        [&](Transaction& transaction) { return CreateJob(transaction, Uuid(number), job); });
  }
  void AddWithPriority(int number, const std::string& robot, int session, int priority) {
    v1::CalibrationJob job = SampleJob(robot, {session});
    job.set_priority(priority);
    ASSERT_TRUE(Create(number, job).ok());
  }
  void SetState(int number, v1::JobState state) {
    ASSERT_TRUE(Write([&](Transaction& transaction) -> absl::Status {
                  v1::CalibrationJob job = *GetJob(transaction, JobName(Uuid(number)));
                  job.set_state(state);
                  return UpdateJob(transaction, job, transaction.revision());
                }).ok());
  }
  // The number of the next job; 0 = none.
  int Next() {
    const auto next = Read([this](Snapshot& snapshot) { return NextJob(snapshot, clock_.Now()); });
    EXPECT_TRUE(next.ok()) << next.status();
    for (int number = 1; number < 20; ++number)
      if (next.ok() && *next == JobName(Uuid(number))) return number;
    return 0;
  }
};

INSTANTIATE_TEST_SUITE_P(Backends, Queue,
                         ::testing::Values(Backend::kSqliteMemory, Backend::kSqliteFile));

// Catches priorities the wrong way round, or equal ones that aren't first come, first served.
TEST_P(Queue, HighestPriorityThenFirstCome) {
  for (int robot : {1, 2, 3, 4}) AddRobotAndSession(*store_, absl::StrCat("r", robot), robot);
  AddWithPriority(7, "r1", 1, 0);
  AddWithPriority(5, "r2", 2, -100);
  AddWithPriority(6, "r3", 3, 100);
  AddWithPriority(4, "r4", 4, 0);
  for (int expected : {6, 7, 4, 5, 0}) {
    EXPECT_EQ(Next(), expected);
    if (expected != 0) SetState(expected, v1::RUNNING);
  }
}

// Catches two running jobs of a robot, a robot that holds up the others, and one that stays
// blocked.
TEST_P(Queue, OneRunningJobARobot) {
  AddRobotAndSession(*store_, "r1", 1);
  AddRobotAndSession(*store_, "r2", 2);
  AddWithPriority(1, "r1", 1, 0);
  AddWithPriority(2, "r1", 1, 100);
  AddWithPriority(3, "r2", 2, 0);
  EXPECT_EQ(Next(), 2);
  SetState(2, v1::RUNNING);
  EXPECT_EQ(Next(), 3);
  SetState(3, v1::RUNNING);
  EXPECT_EQ(Next(), 0);
  SetState(2, v1::SUCCEEDED);
  EXPECT_EQ(Next(), 1);
}

// Catches a job that is given out after its deadline, an hour that passes for a microsecond, and
// jobs without a deadline among the late ones.
TEST_P(Queue, JobsBeyondTheirDeadlineAreFound) {
  AddRobotWithSession(*store_);
  v1::CalibrationJob job = SampleJob("ur10", {1});
  ASSERT_TRUE(Create(3, job).ok());
  *job.mutable_deadline() = ToTimestamp(clock_.Now() + absl::Seconds(2));
  ASSERT_TRUE(Create(2, job).ok());
  *job.mutable_deadline() = ToTimestamp(clock_.Now() + absl::Seconds(1));
  ASSERT_TRUE(Create(1, job).ok());
  SetState(3, v1::CANCELLED);
  const auto late = [&](int limit) {
    return *Read(
        [&](Snapshot& snapshot) { return LatePendingJobs(snapshot, clock_.Now(), limit); });
  };
  clock_.Advance(absl::Seconds(1) - absl::Microseconds(1));
  EXPECT_TRUE(late(9).empty());
  EXPECT_EQ(Next(), 2);
  clock_.Advance(absl::Seconds(1));
  EXPECT_EQ(late(9), std::vector<std::string>{JobName(Uuid(1))});
  clock_.Advance(absl::Microseconds(1));
  EXPECT_EQ(late(9), (std::vector<std::string>{JobName(Uuid(1)), JobName(Uuid(2))}));
  EXPECT_EQ(late(1), std::vector<std::string>{JobName(Uuid(1))});
  EXPECT_EQ(Next(), 0);
}

// Catches what the creator says and the store forgets, an etag that stays, a retry that is taken
// for another job and another job that is taken for a retry.
TEST_P(Queue, TheOrderIsStored) {
  AddRobotWithSession(*store_);
  v1::CalibrationJob asked = SampleJob("ur10", {1});
  asked.set_priority(-7);
  *asked.mutable_deadline() = ToTimestamp(clock_.Now() + absl::Hours(1) + absl::Nanoseconds(1'500));
  asked.set_created_by("anna");
  asked.set_created_by_machine(true);
  asked.set_recalibration_request("robots/ur10/recalibrationRequests/4");
  const auto job = Create(1, asked);
  ASSERT_TRUE(job.ok()) << job.status();
  EXPECT_EQ(job->priority(), -7);
  EXPECT_EQ(DeadlineOf(*job), clock_.Now() + absl::Hours(1) + absl::Microseconds(1));
  EXPECT_EQ(job->created_by(), "anna");
  EXPECT_TRUE(job->created_by_machine());
  EXPECT_EQ(job->recalibration_request(), "robots/ur10/recalibrationRequests/4");
  EXPECT_EQ(job->etag(), ToEtag(job->revision()));
  SetState(1, v1::CANCELLED);
  EXPECT_NE(Create(1, asked)->etag(), job->etag()) << "the job as it is now";
  asked.set_created_by("ben");
  clock_.Advance(absl::Hours(2));
  EXPECT_TRUE(Create(1, asked).ok()) << "a repeat, also when the deadline has passed meanwhile";
  asked.set_priority(7);
  EXPECT_EQ(Create(1, asked).status().code(), absl::StatusCode::kAlreadyExists);
}

// Catches orders that can't be kept, told one at a time.
TEST_P(Queue, OrdersThatAreRefused) {
  AddRobotWithSession(*store_);
  v1::CalibrationJob asked = SampleJob("ur10", {1});
  asked.set_priority(101);
  asked.mutable_deadline()->set_nanos(-1);
  asked.set_recalibration_request("robots/other/recalibrationRequests/1");
  const absl::Status status = Create(1, asked).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(FaultFields(status),
            (std::vector<std::string>{"priority", "deadline", "recalibration_request"}));
  v1::CalibrationJob late = SampleJob("ur10", {1});
  *late.mutable_deadline() = ToTimestamp(clock_.Now());
  EXPECT_EQ(Create(1, late).status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(FaultFields(Create(1, late).status()), std::vector<std::string>{"deadline"});
}

// Catches a preview on other input than the job would have, or that leaves a job behind.
TEST_P(Queue, APreviewReadsWhatTheJobWould) {
  AddRobotWithSession(*store_);
  const v1::CalibrationJob asked = SampleJob("ur10", {1});
  const auto preview = [&](const v1::CalibrationJob& job) {
    return Read([&](Snapshot& snapshot) { return PreviewJobInput(snapshot, Uuid(1), job); });
  };
  const auto before = preview(asked);
  ASSERT_TRUE(before.ok()) << before.status();
  EXPECT_EQ(Next(), 0);
  const auto job = Create(1, asked);
  const auto input = Read([&](Snapshot& snapshot) { return LoadJobInput(snapshot, *job); });
  EXPECT_EQ(before->SerializeAsString(), input->SerializeAsString());
  v1::CalibrationJob other = asked;
  other.set_input_digest("other");
  EXPECT_EQ(preview(other).status().code(), absl::StatusCode::kAlreadyExists) << "as a create";
  other.add_sessions(SessionName(Uuid(9)));
  EXPECT_FALSE(
      Read([&](Snapshot& snapshot) { return PreviewJobInput(snapshot, Uuid(2), other); }).ok());
}

class EqualContent : public Queue {
 protected:
  // The result of a new job with this input digest.
  std::string Result(int job, const std::string& input_digest, const v1::Calibration& result) {
    v1::CalibrationJob asked = SampleJob("ur10", {1});
    asked.set_input_digest(input_digest);
    asked.set_created_by(absl::StrCat("creator of ", job));
    EXPECT_TRUE(Create(job, asked).ok());
    const auto stored = Write([&](Transaction& transaction) {
      return InsertCalibration(transaction, *GetJob(transaction, JobName(Uuid(job))), result);
    });
    EXPECT_TRUE(stored.ok()) << stored.status();
    return stored.ok() ? stored->name() : "";
  }
};

INSTANTIATE_TEST_SUITE_P(Backends, EqualContent, ::testing::Values(Backend::kSqliteMemory));

// Catches a second calibration of the same content, and one that is taken for another although
// something that people decide by differs.
TEST_P(EqualContent, IsStoredOnce) {
  AddRobotWithSession(*store_);
  const std::string first = "robots/ur10/calibrations/1";
  v1::Calibration result = SampleCalibration();
  result.mutable_provenance()->set_seconds(1);
  EXPECT_EQ(Result(1, "input", result), first);
  clock_.Advance(absl::Hours(1));
  result.mutable_provenance()->set_seconds(2);
  EXPECT_EQ(Result(2, "input", result), first) << "another time, another duration";
  EXPECT_EQ(Read([&](Snapshot& snapshot) { return GetCalibration(snapshot, first); })->created_by(),
            "creator of 1");
  EXPECT_EQ(Result(3, "other input", result), "robots/ur10/calibrations/2");
  result.add_sessions(SessionName(Uuid(9)));
  EXPECT_EQ(Result(4, "input", result), "robots/ur10/calibrations/3") << "another session";
  result.set_covariance(0, 0.25);
  EXPECT_EQ(Result(5, "input", result), "robots/ur10/calibrations/4") << "another covariance";
  result.mutable_report()->set_verdict("do_not_apply");
  EXPECT_EQ(Result(6, "input", result), "robots/ur10/calibrations/5") << "another verdict";
}

}  // namespace
}  // namespace truepose::store
