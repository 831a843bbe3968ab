#include "server/services/jobs.h"

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "server/services/robots.h"
#include "server/services/sessions.h"
#include "tests/server/testing/handler_test.h"

namespace truepose::services {
namespace {

using testing::HandlerTest;
using testing::HasCode;
using testing::HasFaultsAt;
using testing::HasFields;
using testing::IsOk;
using testing::kJob1;
using testing::kJob2;
using testing::kSession1;
using testing::kSession2;
using testing::kUnknown;
using testing::Parse;
using Fields = std::vector<std::string>;

v1::CreateCalibrationJobRequest Request(const std::string& job_id,
                                        const std::vector<std::string>& session_ids) {
  v1::CreateCalibrationJobRequest request;
  request.set_job_id(job_id);
  request.set_robot("robots/ur10");
  for (const std::string& id : session_ids) request.add_sessions(absl::StrCat("sessions/", id));
  request.mutable_options()->set_split("even-odd");
  return request;
}

template <typename T>
T Named(const std::string& name) {
  T request;
  request.set_name(name);
  return request;
}

std::string JobName(const std::string& id) { return absl::StrCat("jobs/", id); }

class JobsTest : public HandlerTest {
 protected:
  JobsTest() { AddRobot("ur10"); }
};

// Would catch a job without its frozen input.
TEST_F(JobsTest, CreatedJobIsPendingWithFrozenInput) {
  AddSealedSession(kSession1, "ur10");
  AddSealedSession(kSession2, "ur10");
  const auto job = CreateCalibrationJob(call(), Request(kJob1, {kSession1, kSession2}));
  ASSERT_THAT(job, IsOk());
  EXPECT_THAT(*job, HasFields(absl::StrCat(R"pb(name: "jobs/)pb", kJob1,
                                           R"pb("
                                                robot: "robots/ur10"
                                                nominal_revision: "robots/ur10/nominals/1"
                                                options { split: "even-odd" }
                                                state: PENDING)pb")));
  EXPECT_EQ(job->sessions_size(), 2);
  EXPECT_EQ(job->input_digest().size(), 64u);
  const auto got = GetCalibrationJob(call(), Named<v1::GetCalibrationJobRequest>(JobName(kJob1)));
  ASSERT_THAT(got, IsOk());
  EXPECT_EQ(got->input_digest(), job->input_digest());
}

// Would catch a job that runs twice because its answer was lost, or an id that stands for two jobs.
TEST_F(JobsTest, RepeatedCreateReturnsTheJobAndAnotherIsRefused) {
  AddSealedSession(kSession1, "ur10");
  const auto first = CreateCalibrationJob(call(), Request(kJob1, {kSession1}));
  const auto second = CreateCalibrationJob(call(), Request(kJob1, {kSession1}));
  ASSERT_THAT(second, IsOk());
  EXPECT_EQ(first->SerializeAsString(), second->SerializeAsString());
  auto other = Request(kJob1, {kSession1});
  other.mutable_options()->set_split("every:2");
  EXPECT_THAT(CreateCalibrationJob(call(), other), HasCode(absl::StatusCode::kAlreadyExists));
}

// Would catch faults told one at a time.
TEST_F(JobsTest, CreateNamesEveryFault) {
  auto request = Request("no-uuid", {kSession1, kSession1});
  request.add_sessions("session");
  request.set_robot("ur10");
  request.mutable_options()->set_split("odd-even");
  EXPECT_THAT(
      CreateCalibrationJob(call(), request),
      HasFaultsAt(Fields{"job_id", "robot", "sessions[1]", "sessions[2]", "options.split"}));
  EXPECT_THAT(CreateCalibrationJob(call(), Request(kJob1, {})), HasFaultsAt(Fields{"sessions"}));
}

TEST_F(JobsTest, CreateNeedsItsRobotAndSessions) {
  AddSealedSession(kSession1, "ur10");
  EXPECT_THAT(CreateCalibrationJob(call(), Request(kJob1, {kUnknown})),
              HasCode(absl::StatusCode::kNotFound));
  auto request = Request(kJob1, {kSession1});
  request.set_robot("robots/none");
  EXPECT_THAT(CreateCalibrationJob(call(), request), HasCode(absl::StatusCode::kNotFound));
}

// Would catch a calibration of what somebody has thrown away.
TEST_F(JobsTest, CreateRefusesADeletedSession) {
  AddSealedSession(kSession1, "ur10");
  v1::DeleteSessionRequest gone;
  gone.set_name(absl::StrCat("sessions/", kSession1));
  ASSERT_THAT(DeleteSession(call(), gone), IsOk());
  EXPECT_THAT(CreateCalibrationJob(call(), Request(kJob1, {kSession1})),
              HasCode(absl::StatusCode::kFailedPrecondition));
}

// Would catch a calibration of readings that may still change, of another robot, or under two
// geometries.
TEST_F(JobsTest, CreateNamesEverySessionThatCannotBeUsed) {
  AddRobot("other");
  AddSealedSession(kSession1, "ur10");
  AddSession(kSession2, "other", 2);
  v1::CreateNominalRevisionRequest revision;
  revision.set_parent("robots/ur10");
  *revision.mutable_nominal() = testing::SixAxes("2");
  ASSERT_THAT(CreateNominalRevision(call(), revision), IsOk());
  constexpr char kSession3[] = "00000000-0000-4000-8000-000000000003";
  AddSealedSession(kSession3, "ur10");
  const auto job = CreateCalibrationJob(call(), Request(kJob1, {kSession1, kSession2, kSession3}));
  ASSERT_THAT(job, HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_EQ(testing::FieldsOf(job.status()), (Fields{"sessions[1]", "sessions[1]", "sessions[2]"}));
  const std::string message(job.status().message());
  EXPECT_THAT(message, ::testing::HasSubstr("OPEN, expected SEALED"));
  EXPECT_THAT(message, ::testing::HasSubstr("of robots/other, expected a session of robots/ur10"));
  EXPECT_THAT(message, ::testing::HasSubstr("robots/ur10/nominals/2"));
}

// Would catch a preview that stores or runs something, or that says nothing of the readings.
TEST_F(JobsTest, ValidateOnlyTellsWhatWouldBeIdentified) {
  AddSimulatedSession(kSession1, "ur10", 60);
  auto request = Request(kJob1, {kSession1});
  request.set_validate_only(true);
  const auto job = CreateCalibrationJob(call(), request);
  ASSERT_THAT(job, IsOk());
  EXPECT_EQ(job->state(), v1::JOB_STATE_UNSPECIFIED);
  EXPECT_EQ(job->preview().readings(), 60);
  EXPECT_EQ(job->preview().counts().complete(), 30) << "4 R + 6, Eq. 11";
  EXPECT_EQ(job->preview().counts().rank(), job->preview().identifiable_size());
  EXPECT_GT(job->preview().identifiable_size(), 12) << "more than base and tool";
  EXPECT_GT(job->preview().redundancies_size(), 0) << "parallel axes";
  EXPECT_THAT(GetCalibrationJob(call(), Named<v1::GetCalibrationJobRequest>(JobName(kJob1))),
              HasCode(absl::StatusCode::kNotFound));
  request.set_validate_only(false);
  const auto created = CreateCalibrationJob(call(), request);
  ASSERT_THAT(created, IsOk());
  EXPECT_EQ(created->input_digest(), job->input_digest());
  EXPECT_FALSE(created->has_preview());
}

// Would catch a preview of what a create refuses.
TEST_F(JobsTest, ValidateOnlyRefusesWhatACreateRefuses) {
  AddSession(kSession1, "ur10", 3);
  auto request = Request(kJob1, {kSession1});
  request.set_validate_only(true);
  EXPECT_THAT(CreateCalibrationJob(call(), request),
              HasCode(absl::StatusCode::kFailedPrecondition));
  AddSealedSession(kSession2, "ur10");
  ASSERT_THAT(CreateCalibrationJob(call(), Request(kJob1, {kSession2})), IsOk());
  auto other = Request(kJob1, {kSession2});
  other.mutable_options()->set_split("every:2");
  other.set_validate_only(true);
  EXPECT_THAT(CreateCalibrationJob(call(), other), HasCode(absl::StatusCode::kAlreadyExists));
}

// Would catch fields of the request that don't reach the job.
TEST_F(JobsTest, CreateKeepsPriorityAndDeadline) {
  AddSealedSession(kSession1, "ur10");
  auto request = Request(kJob1, {kSession1});
  request.set_priority(40);
  request.mutable_deadline()->set_seconds(4'000'000'000);
  const auto job = CreateCalibrationJob(call(), request);
  ASSERT_THAT(job, IsOk());
  EXPECT_EQ(job->priority(), 40);
  EXPECT_EQ(job->deadline().seconds(), 4'000'000'000);
  EXPECT_NE(job->etag(), "");
  request.set_job_id(kJob2);
  request.set_priority(-101);
  request.mutable_deadline()->set_seconds(-1);
  EXPECT_THAT(CreateCalibrationJob(call(), request), HasFaultsAt(Fields{"priority", "deadline"}));
}

TEST_F(JobsTest, GetTellsUnknownFromMalformed) {
  EXPECT_THAT(GetCalibrationJob(call(), Named<v1::GetCalibrationJobRequest>(JobName(kUnknown))),
              HasCode(absl::StatusCode::kNotFound));
  EXPECT_THAT(GetCalibrationJob(call(), Named<v1::GetCalibrationJobRequest>("jobs/1")),
              HasFaultsAt(Fields{"name"}));
}

// Would catch a list in another order or of another robot.
TEST_F(JobsTest, ListIsNewestFirstAndOfOneRobot) {
  AddSealedSession(kSession1, "ur10");
  ASSERT_THAT(CreateCalibrationJob(call(), Request(kJob2, {kSession1})), IsOk());
  ASSERT_THAT(CreateCalibrationJob(call(), Request(kJob1, {kSession1})), IsOk());
  const auto jobs = ListCalibrationJobs(
      call(), Parse<v1::ListCalibrationJobsRequest>(R"pb(robot: "robots/ur10")pb"));
  ASSERT_THAT(jobs, IsOk());
  ASSERT_EQ(jobs->jobs_size(), 2);
  EXPECT_EQ(jobs->jobs(0).name(), JobName(kJob1));
  EXPECT_THAT(ListCalibrationJobs(call(), Parse<v1::ListCalibrationJobsRequest>("page_size: -1")),
              HasFaultsAt(Fields{"page_size"}));
}

// Would catch a filter that is not asked, one that pages with its items left out, and a page token
// that is taken under another filter.
TEST_F(JobsTest, ListTakesAFilter) {
  AddSealedSession(kSession1, "ur10");
  for (const char* id : {kJob1, kJob2})
    ASSERT_THAT(CreateCalibrationJob(call(), Request(id, {kSession1})), IsOk());
  ASSERT_THAT(CancelCalibrationJob(call(), Named<v1::CancelCalibrationJobRequest>(JobName(kJob1))),
              IsOk());
  auto request = Parse<v1::ListCalibrationJobsRequest>(R"pb(filter: "state = \"CANCELLED\"")pb");
  const auto jobs = ListCalibrationJobs(call(), request);
  ASSERT_THAT(jobs, IsOk());
  ASSERT_EQ(jobs->jobs_size(), 1);
  EXPECT_EQ(jobs->jobs(0).name(), JobName(kJob1));
  const auto first =
      ListCalibrationJobs(call(), Parse<v1::ListCalibrationJobsRequest>("page_size: 1"));
  request.set_page_token(first->next_page_token());
  EXPECT_THAT(ListCalibrationJobs(call(), request), HasFaultsAt(Fields{"page_token"}));
  EXPECT_THAT(ListCalibrationJobs(
                  call(), Parse<v1::ListCalibrationJobsRequest>(R"pb(filter: "colour = 1")pb")),
              HasFaultsAt(Fields{"filter"}));
}

// Would catch a cancel that is lost or can't be repeated.
TEST_F(JobsTest, CancelEndsAPendingJobAndMayBeRepeated) {
  AddSealedSession(kSession1, "ur10");
  ASSERT_THAT(CreateCalibrationJob(call(), Request(kJob1, {kSession1})), IsOk());
  const auto request = Named<v1::CancelCalibrationJobRequest>(JobName(kJob1));
  for (int i = 0; i < 2; ++i) {
    const auto job = CancelCalibrationJob(call(), request);
    ASSERT_THAT(job, IsOk());
    EXPECT_EQ(job->state(), v1::CANCELLED);
  }
}

TEST_F(JobsTest, CancelTellsUnknownFromMalformed) {
  EXPECT_THAT(
      CancelCalibrationJob(call(), Named<v1::CancelCalibrationJobRequest>(JobName(kUnknown))),
      HasCode(absl::StatusCode::kNotFound));
  EXPECT_THAT(CancelCalibrationJob(call(), Named<v1::CancelCalibrationJobRequest>("1")),
              HasFaultsAt(Fields{"name"}));
}

// Would catch a watch that never tells the state it began with, or never ends.
TEST_F(JobsTest, WatchTellsTheStateAndEndsAfterTheLast) {
  AddSealedSession(kSession1, "ur10");
  ASSERT_THAT(CreateCalibrationJob(call(), Request(kJob1, {kSession1})), IsOk());
  ASSERT_THAT(CancelCalibrationJob(call(), Named<v1::CancelCalibrationJobRequest>(JobName(kJob1))),
              IsOk());
  ASSERT_THAT(engine().Start(), IsOk());
  absl::Notification done;
  v1::JobState last = v1::JOB_STATE_UNSPECIFIED;
  absl::Status ended = absl::UnknownError("not ended");
  const auto watch =
      WatchCalibrationJob(call(), Named<v1::WatchCalibrationJobRequest>(JobName(kJob1)),
                          {.on_job = [&](const v1::CalibrationJob& job) { last = job.state(); },
                           .on_done =
                               [&](const absl::Status& status) {
                                 ended = status;
                                 done.Notify();
                               }});
  ASSERT_THAT(watch, IsOk());
  ASSERT_TRUE(done.WaitForNotificationWithTimeout(absl::Seconds(20)));
  EXPECT_EQ(last, v1::CANCELLED);
  EXPECT_THAT(ended, IsOk());
}

TEST_F(JobsTest, WatchNeedsItsJob) {
  ASSERT_THAT(engine().Start(), IsOk());
  const jobs::WatchCallbacks nothing{.on_job = [](const v1::CalibrationJob&) {},
                                     .on_done = [](const absl::Status&) {}};
  EXPECT_THAT(
      WatchCalibrationJob(call(), Named<v1::WatchCalibrationJobRequest>(JobName(kUnknown)), nothing)
          .status(),
      HasCode(absl::StatusCode::kNotFound));
}

}  // namespace
}  // namespace truepose::services
