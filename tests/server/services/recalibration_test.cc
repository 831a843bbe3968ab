#include "server/services/recalibration.h"

#include "server/services/jobs.h"
#include "server/services/recalibration_job.h"
#include "server/services/recalibration_rules.h"
#include "server/services/robots.h"
#include "server/store/jobs.h"
#include "tests/server/services/recalibration_testing.h"

namespace truepose::services {
namespace {

using testing::HasCode;
using testing::HasFaultsAt;
using testing::HasFields;
using testing::IsOk;
using testing::kSession1;
using testing::kSession2;
using Fields = std::vector<std::string>;

constexpr char kMeasured[] = "sessions/00000000-0000-4000-8000-000000000002";

class RecalibrationTest : public RecalibrationFixture {
 protected:
  // A request whose job waits; its session is kMeasured.
  v1::RecalibrationRequest Calibrating() {
    EXPECT_THAT(Ask(kRequest1), IsOk());
    EXPECT_THAT(Acknowledge(kRequest1), IsOk());
    AddSimulatedSession(kSession2, "ur10", testing::kCalibrationPoses);
    EXPECT_THAT(Measure(kRequest1, kMeasured, testing::kCalibrationPoses), IsOk());
    const auto calibrating = Calibrate(kRequest1);
    EXPECT_THAT(calibrating, IsOk());
    return calibrating.value_or(v1::RecalibrationRequest());
  }

  v1::CalibrationJob JobOf(const v1::RecalibrationRequest& request) {
    auto job = store().Read(
        [&](store::Snapshot& snapshot) { return store::GetJob(snapshot, request.job()); });
    EXPECT_THAT(job, IsOk());
    return job.value_or(v1::CalibrationJob());
  }

  // As the engine tells of the end of a job.
  void End(v1::CalibrationJob job, v1::JobState state, const std::string& calibration,
           const std::string& error = "") {
    job.set_state(state);
    job.set_calibration(calibration);
    job.mutable_error()->set_message(error);
    ASSERT_THAT(store().Write([&](store::Transaction& transaction) {
      return MoveRequestOfJob(transaction, job);
    }),
                IsOk());
  }
};

// Would catch a request without poses, or one whose poses nobody can get.
TEST_F(RecalibrationTest, CarriesThinnedPosesOfTheActiveSession) {
  const auto request = Ask(kRequest1);
  ASSERT_THAT(request, IsOk());
  EXPECT_THAT(*request, HasFields("state: REQUEST_PENDING cause: CAUSE_PERSON reason: 'a bump' "
                                  "created_by: 'anna' raised_by: ''"));
  EXPECT_EQ(request->steps_size(), 1);
  const auto poses = store().Read([&](store::Snapshot& snapshot) {
    return GetResource<v1::PoseSet>(snapshot, request->pose_set());
  });
  ASSERT_THAT(poses, IsOk());
  EXPECT_EQ(poses->poses_size(), 20);
  EXPECT_EQ(poses->origin(), absl::StrCat("thinned from sessions/", kSession1));
}

// Would catch a set that is thinned although one was asked for or a policy names one, and the set
// of a robot with other joints.
TEST_F(RecalibrationTest, AnUploadedPoseSetIsTakenAsItIs) {
  AddRobot("other");
  const std::string foreign = AddPoseSet("theirs", "robots/other");
  EXPECT_THAT(Ask(kRequest1, absl::StrCat("pose_set: '", foreign, "'")),
              HasFaultsAt(Fields{"recalibration_request.pose_set"}));
  const std::string policys = AddPoseSet("usual"), asked = AddPoseSet("short");
  SetPolicy(absl::StrCat("pose_set: '", policys, "'"));
  EXPECT_EQ(Ask(kRequest1)->pose_set(), policys);
  ASSERT_THAT(Decline(kRequest1), IsOk());
  EXPECT_EQ(Ask(kRequest2, absl::StrCat("pose_set: '", asked, "'"))->pose_set(), asked);
  EXPECT_EQ(All<v1::PoseSet>().size(), 2u);
}

// Would catch two open requests of one robot, and a refusal that doesn't say which one is open.
TEST_F(RecalibrationTest, OneIsOpenAtATime) {
  ASSERT_THAT(Ask(kRequest1), IsOk());
  const auto second = Ask(kRequest2);
  EXPECT_THAT(second, HasCode(absl::StatusCode::kAlreadyExists));
  EXPECT_THAT(std::string(second.status().message()), ::testing::HasSubstr(RequestName(kRequest1)));
  ASSERT_THAT(Decline(kRequest1), IsOk());
  EXPECT_THAT(Ask(kRequest2), IsOk());
}

// Would catch a repeat that makes a second request, or one that fails because its pose set was made
// by the server.
TEST_F(RecalibrationTest, TheSameIdIsOneRequest) {
  const auto first = Ask(kRequest1);
  ASSERT_THAT(first, IsOk());
  const auto again = Ask(kRequest1);
  ASSERT_THAT(again, IsOk());
  EXPECT_EQ(first->SerializeAsString(), again->SerializeAsString());
  EXPECT_THAT(Ask(kRequest1, "reason: 'another'"), HasCode(absl::StatusCode::kAlreadyExists));
  EXPECT_EQ(All<v1::PoseSet>().size(), 1u);
}

// Would catch a caller who says that the server found the cause, and faults told one by one.
TEST_F(RecalibrationTest, NamesEveryFaultOfARequest) {
  EXPECT_THAT(Ask("x", "cause: CAUSE_INTERVAL raised_by: 'robots/ur10/driftChecks/1'"),
              HasFaultsAt(Fields{"recalibration_request_id", "recalibration_request.cause",
                                 "recalibration_request.raised_by"}));
  EXPECT_THAT(Ask(kRequest1, "expire_time { seconds: 1 }"),
              HasFaultsAt(Fields{"recalibration_request.expire_time"}));
  EXPECT_THAT(Ask(kRequest1, "calibrate: 'dq3, dq99'"),
              HasFaultsAt(Fields{"recalibration_request.options.calibrate"}));
  EXPECT_THAT(Ask(kRequest1, "pose_set: 'robots/ur10/poseSets/none'"),
              HasCode(absl::StatusCode::kNotFound));
  EXPECT_TRUE(All<v1::RecalibrationRequest>().empty());
}

// Would catch a request that nobody can act on: without poses, and without a word why.
TEST_F(RecalibrationTest, WithoutAnActiveCalibrationAPoseSetIsNeeded) {
  AddRobot("new");
  v1::CreateRecalibrationRequestRequest request;
  request.set_parent("robots/new");
  request.set_recalibration_request_id(kRequest1);
  EXPECT_THAT(CreateRecalibrationRequest(call(), request),
              HasCode(absl::StatusCode::kFailedPrecondition));
}

// The table of the header, whole: would catch a step too many or one that is missing.
TEST(RecalibrationRules, OnlyTheseStepsLeadOn) {
  using S = v1::RecalibrationState;
  const auto may = [](S from, S to) {
    v1::RecalibrationRequest request;
    request.set_state(from);
    return CheckStep(request, to).ok();
  };
  std::vector<std::pair<S, S>> found;
  for (int from = v1::REQUEST_PENDING; from <= v1::REQUEST_EXPIRED; ++from)
    for (int to = v1::REQUEST_PENDING; to <= v1::REQUEST_EXPIRED; ++to)
      if (may(static_cast<S>(from), static_cast<S>(to)))
        found.emplace_back(static_cast<S>(from), static_cast<S>(to));
  std::vector<std::pair<S, S>> expected = {{v1::REQUEST_PENDING, v1::REQUEST_ACKNOWLEDGED},
                                           {v1::REQUEST_ACKNOWLEDGED, v1::REQUEST_MEASURING},
                                           {v1::REQUEST_MEASURING, v1::REQUEST_MEASURING},
                                           {v1::REQUEST_MEASURING, v1::REQUEST_CALIBRATING}};
  for (const S open : {v1::REQUEST_PENDING, v1::REQUEST_ACKNOWLEDGED, v1::REQUEST_MEASURING,
                       v1::REQUEST_CALIBRATING}) {
    expected.emplace_back(open, v1::REQUEST_DECLINED);
    expected.emplace_back(open, v1::REQUEST_EXPIRED);
  }
  EXPECT_THAT(found, ::testing::UnorderedElementsAreArray(expected));
}

// Would catch a refusal that leaves the caller to guess what to do.
TEST_F(RecalibrationTest, AWrongStepSaysWhatIsPossible) {
  ASSERT_THAT(Ask(kRequest1), IsOk());
  const auto refused = Calibrate(kRequest1);
  EXPECT_THAT(refused, HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_THAT(std::string(refused.status().message()),
              ::testing::AllOf(::testing::HasSubstr("which is pending"),
                               ::testing::HasSubstr("acknowledged")));
}

// Would catch a session of another robot, and a report of readings that is a step each time.
TEST_F(RecalibrationTest, MeasuringNamesASessionOfTheRobot) {
  ASSERT_THAT(Ask(kRequest1), IsOk());
  ASSERT_THAT(Acknowledge(kRequest1), IsOk());
  AddRobot("other");
  AddSession(kSession2, "other", 3);
  EXPECT_THAT(Measure(kRequest1, kMeasured, 0), HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_THAT(Measure(kRequest1, "", 0), HasFaultsAt(Fields{"session"}));
  const std::string own = absl::StrCat("sessions/", kSession1);
  ASSERT_THAT(Measure(kRequest1, own, 0), IsOk());
  const auto more = Measure(kRequest1, "", 7);
  ASSERT_THAT(more, IsOk());
  EXPECT_EQ(more->readings_taken(), 7);
  EXPECT_EQ(more->steps_size(), 3);
  EXPECT_EQ(Measure(kRequest1, "", 7)->revision(), more->revision());
}

// Would catch a job over readings that may still change.
TEST_F(RecalibrationTest, CalibratesASealedSessionOnly) {
  ASSERT_THAT(Ask(kRequest1), IsOk());
  ASSERT_THAT(Acknowledge(kRequest1), IsOk());
  AddSession(kSession2, "ur10", 3);
  ASSERT_THAT(Measure(kRequest1, kMeasured, 3), IsOk());
  EXPECT_THAT(Calibrate(kRequest1), HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_EQ(Stored(kRequest1).state(), v1::REQUEST_MEASURING);
}

// Would catch a job without its request, or one that a person seems to have made.
TEST_F(RecalibrationTest, TheJobBelongsToTheRequest) {
  const v1::RecalibrationRequest request = Calibrating();
  EXPECT_EQ(request.state(), v1::REQUEST_CALIBRATING);
  const v1::CalibrationJob job = JobOf(request);
  EXPECT_EQ(job.recalibration_request(), request.name());
  EXPECT_TRUE(job.created_by_machine());
  ASSERT_EQ(job.sessions_size(), 1);
  EXPECT_EQ(job.sessions(0), kMeasured);
}

// Would catch a request that waits for ever for a job that has ended.
TEST_F(RecalibrationTest, TheJobsEndMovesItsRequest) {
  const v1::RecalibrationRequest request = Calibrating();
  const v1::CalibrationJob job = JobOf(request);
  End(job, v1::FAILED, "", "too few rows");
  const v1::RecalibrationRequest back = Stored(kRequest1);
  EXPECT_EQ(back.state(), v1::REQUEST_MEASURING);
  EXPECT_EQ(back.job(), "");
  EXPECT_THAT(back.steps(back.steps_size() - 1).reason(), ::testing::HasSubstr("too few rows"));
  const auto again = Calibrate(kRequest1);
  ASSERT_THAT(again, IsOk());
  // The end of the job before says nothing any more.
  End(job, v1::SUCCEEDED, "robots/ur10/calibrations/8");
  EXPECT_EQ(Stored(kRequest1).state(), v1::REQUEST_CALIBRATING);
  End(JobOf(*again), v1::SUCCEEDED, "robots/ur10/calibrations/9");
  EXPECT_THAT(Stored(kRequest1),
              HasFields("state: REQUEST_DONE calibration: 'robots/ur10/calibrations/9'"));
}

// Would catch a declined request that comes back to life by its job.
TEST_F(RecalibrationTest, ADeclinedRequestStaysDeclined) {
  const v1::RecalibrationRequest request = Calibrating();
  ASSERT_THAT(Decline(kRequest1), IsOk());
  End(JobOf(request), v1::SUCCEEDED, "robots/ur10/calibrations/9");
  EXPECT_EQ(Stored(kRequest1).state(), v1::REQUEST_DECLINED);
  v1::DeclineRecalibrationRequest silent;
  silent.set_name(request.name());
  EXPECT_THAT(DeclineRecalibration(call(), silent), HasFaultsAt(Fields{"reason"}));
}

// A person's own options: would catch a job whose request is a name that nobody looks at.
TEST_F(RecalibrationTest, AJobOfAPersonAnswersARequestToo) {
  ASSERT_THAT(Ask(kRequest1), IsOk());
  v1::CreateCalibrationJobRequest job;
  job.set_job_id(testing::kJob2);
  job.set_robot(kRobot);
  job.add_sessions(absl::StrCat("sessions/", kSession1));
  job.set_recalibration_request(RequestName(kRequest1));
  EXPECT_THAT(CreateCalibrationJob(call(), job), HasCode(absl::StatusCode::kFailedPrecondition));
  ASSERT_THAT(Acknowledge(kRequest1), IsOk());
  ASSERT_THAT(Measure(kRequest1, job.sessions(0), 60), IsOk());
  ASSERT_THAT(CreateCalibrationJob(call(), job), IsOk());
  ASSERT_THAT(CreateCalibrationJob(call(), job), IsOk());
  EXPECT_THAT(Stored(kRequest1), HasFields(absl::StrCat("state: REQUEST_CALIBRATING job: 'jobs/",
                                                        testing::kJob2, "'")));
}

// Would catch a partial recalibration that falls back to nominal in everything else.
TEST_F(RecalibrationTest, APartStartsFromTheActiveCalibration) {
  ASSERT_THAT(Ask(kRequest1, "calibrate: 'dq3'"), IsOk());
  ASSERT_THAT(Acknowledge(kRequest1), IsOk());
  ASSERT_THAT(Measure(kRequest1, absl::StrCat("sessions/", kSession1), 60), IsOk());
  const auto calibrating = Calibrate(kRequest1);
  ASSERT_THAT(calibrating, IsOk());
  const v1::CalibrationOptions options = JobOf(*calibrating).options();
  EXPECT_EQ(options.calibrate(), "dq3");
  EXPECT_EQ(options.prior(), "calibration");
  EXPECT_EQ(options.prior_calibration().name(), "robots/ur10/calibrations/1");
}

// Would catch a part that is identified beside values which another nominal gives their meaning.
TEST_F(RecalibrationTest, APartNeedsTheNominalOfTheActiveCalibration) {
  ASSERT_THAT(Ask(kRequest1, "calibrate: 'dq3'"), IsOk());
  ASSERT_THAT(Acknowledge(kRequest1), IsOk());
  v1::CreateNominalRevisionRequest revision;
  revision.set_parent(kRobot);
  *revision.mutable_nominal() = testing::SixAxes("2");
  ASSERT_THAT(CreateNominalRevision(call(), revision), IsOk());
  AddSimulatedSession(kSession2, "ur10", testing::kCalibrationPoses);
  ASSERT_THAT(Measure(kRequest1, kMeasured, 60), IsOk());
  EXPECT_THAT(Calibrate(kRequest1), HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_EQ(Stored(kRequest1).state(), v1::REQUEST_MEASURING);
}

// Would catch reports that pile up, and one of a robot that nobody knows.
TEST_F(RecalibrationTest, TheLatestReportOfAnAgentCounts) {
  v1::ReportAgentRequest request;
  *request.mutable_agent_report() = testing::Parse<v1::AgentReport>(
      "name: 'agentReports/cell-7' robot: 'robots/ur10' version: '1' spooled_readings: 5");
  ASSERT_THAT(ReportAgent(call(), request), IsOk());
  request.mutable_agent_report()->set_spooled_readings(0);
  const auto latest = ReportAgent(call(), request);
  ASSERT_THAT(latest, IsOk());
  EXPECT_THAT(*latest, HasFields("version: '1' spooled_readings: 0"));
  EXPECT_TRUE(latest->has_create_time());
  request.mutable_agent_report()->set_robot("robots/none");
  EXPECT_THAT(ReportAgent(call(), request), HasCode(absl::StatusCode::kNotFound));
}

}  // namespace
}  // namespace truepose::services
