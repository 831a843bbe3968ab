// The whole life of a calibration, as a plant's programs live it.
#include <set>

#include "absl/strings/str_cat.h"
#include "client/append_readings.h"
#include "client/pager.h"
#include "client/wait_for_job.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/expect_status.h"
#include "tests/server/testing/text_proto.h"

namespace truepose {
namespace {

using testing::HasCode;
using testing::HasFields;
using testing::Import;
using testing::IsOk;
using testing::JobRequest;
using testing::MeasuringSession;
using testing::Uuid;

class LifeTest : public testing::ServerFixture {
 protected:
  // Imports a session and calibrates; returns the name of the calibration.
  std::string Calibrate(int poses) {
    Import(client_, "arm", Uuid(1), MeasuringSession(poses, 1));
    const auto created = client_.CreateCalibrationJob(JobRequest(Uuid(2), "arm", Uuid(1)));
    EXPECT_THAT(created, IsOk());
    const auto job = client::WaitForJob(client_, absl::StrCat("jobs/", Uuid(2)));
    EXPECT_THAT(job, IsOk());
    EXPECT_THAT(*job, HasFields("state: SUCCEEDED attempts: 1"));
    return job->calibration();
  }

  const client::Client client_ = NewClient();
};

// Would catch a step of the chain that loses or changes what the one before it made.
TEST_F(LifeTest, FromRobotToCalibration) {
  const std::string name = Calibrate(120);
  EXPECT_EQ(name, "robots/arm/calibrations/1");
  v1::GetCalibrationRequest request;
  request.set_name(name);
  const auto calibration = client_.GetCalibration(request);
  ASSERT_THAT(calibration, IsOk());
  EXPECT_THAT(*calibration,
              HasFields(absl::StrCat(R"pb(nominal_revision: "robots/arm/nominals/1"
                                          sessions: "sessions/)pb",
                                     Uuid(1), R"pb("
                                                   job: "jobs/)pb",
                                     Uuid(2), R"pb("
                                                   options { split: "even-odd" })pb")));
  const v1::Sets& sets = calibration->report().sets();
  EXPECT_EQ(sets.calibration().poses(), 60);
  EXPECT_EQ(sets.control().poses(), 60);
  EXPECT_LT(sets.control().after().position_mm().rms(),
            0.5 * sets.control().before().position_mm().rms());
  EXPECT_EQ(calibration->residuals_size(), 120);
  EXPECT_GT(calibration->internal_parameters_size(), 10);
  EXPECT_EQ(calibration->digest().size(), 64u);
  EXPECT_NE(calibration->provenance().version(), "");
}

// Would catch a server that calibrates otherwise than a program without one: every bit is the same.
TEST_F(LifeTest, SameBitsAsWithoutAServer) {
  v1::GetCalibrationRequest request;
  request.set_name(Calibrate(60));
  const auto remote = client_.GetCalibration(request);
  ASSERT_THAT(remote, IsOk());
  v1::CalibrationInput input;
  *input.mutable_nominal() = convert::MeasuringRobot();
  *input.add_sessions() = MeasuringSession(60, 1);
  input.mutable_options()->set_split("even-odd");
  const auto local = convert::RunCalibration(input);
  ASSERT_THAT(local, IsOk());
  EXPECT_EQ(remote->report().SerializeAsString(), local->report().SerializeAsString());
  EXPECT_EQ(remote->digest(), local->digest());
  ASSERT_EQ(remote->internal_parameters_size(), local->internal_parameters_size());
  for (int i = 0; i < local->internal_parameters_size(); ++i) {
    EXPECT_EQ(remote->internal_parameters(i).SerializeAsString(),
              local->internal_parameters(i).SerializeAsString());
  }
}

// Would catch a watch that tells nothing between the beginning and the end.
TEST_F(LifeTest, AWatchTellsHowTheJobGoes) {
  Import(client_, "arm", Uuid(1), MeasuringSession(200, 1));
  ASSERT_THAT(client_.CreateCalibrationJob(JobRequest(Uuid(2), "arm", Uuid(1))), IsOk());
  std::vector<v1::JobState> states;
  const auto job =
      client::WaitForJob(client_, absl::StrCat("jobs/", Uuid(2)),
                         {.on_change = [&](const auto& seen) { states.push_back(seen.state()); }});
  ASSERT_THAT(job, IsOk());
  EXPECT_TRUE(std::is_sorted(states.begin(), states.end()))
      << "a state was told after its successor";
  EXPECT_EQ(states.back(), v1::SUCCEEDED);
}

// Would catch an evaluation of other readings than those it names.
TEST_F(LifeTest, ACalibrationIsEvaluatedOnAnotherSession) {
  v1::EvaluateRequest request;
  request.set_calibration(Calibrate(80));
  Import(client_, "arm", Uuid(3), MeasuringSession(40, 1));
  request.set_session(absl::StrCat("sessions/", Uuid(3)));
  const auto other = client_.Evaluate(request);
  ASSERT_THAT(other, IsOk());
  EXPECT_EQ(other->set().poses(), 40);
  EXPECT_EQ(other->calibration(), request.calibration());
  EXPECT_TRUE(other->warnings().empty());
  request.set_session(absl::StrCat("sessions/", Uuid(1)));
  const auto own = client_.Evaluate(request);
  ASSERT_THAT(own, IsOk());
  ASSERT_EQ(own->warnings_size(), 1);
  EXPECT_LT(own->set().after().position_mm().rms(), own->set().before().position_mm().rms());
}

// Would catch faults that arrive without their field, or one at a time.
TEST_F(LifeTest, FaultsArriveWithTheirFields) {
  v1::CreateRobotRequest request;
  request.set_robot_id("No Robot");
  *request.mutable_nominal() = convert::MeasuringRobot();
  request.mutable_nominal()->mutable_joints(1)->set_lower(1.0);
  request.mutable_nominal()->mutable_joints(1)->set_upper(-1.0);
  const auto refused = client_.CreateRobot(request);
  ASSERT_THAT(refused, HasCode(absl::StatusCode::kInvalidArgument));
  const auto fields = testing::FieldsOf(refused.status());
  EXPECT_THAT(fields, ::testing::Contains("robot_id"));
  EXPECT_THAT(fields, ::testing::Contains(::testing::StartsWith("nominal.joints[1]")));
}

// Would catch an error too large for its frame: 200 faults have to arrive.
TEST_F(LifeTest, ManyFaultsArrive) {
  Import(client_, "arm", Uuid(1), MeasuringSession(20, 1));
  v1::CreateSessionRequest session;
  session.set_session_id(Uuid(4));
  session.mutable_session()->set_robot("robots/arm");
  ASSERT_THAT(client_.CreateSession(session), IsOk());
  auto input = MeasuringSession(250, 2);
  std::vector<v1::Reading> readings(input.readings().begin(), input.readings().end());
  for (v1::Reading& reading : readings) reading.add_joints_measured(0.0);
  const auto refused =
      client::AppendReadings(client_, absl::StrCat("sessions/", Uuid(4)), readings);
  ASSERT_THAT(refused, HasCode(absl::StatusCode::kInvalidArgument));
  EXPECT_EQ(FaultsOf(refused.status()).size(), 200u);
  EXPECT_THAT(std::string(refused.status().message()), ::testing::HasSubstr("and 50 more"));
}

// Would catch a failed job that hides why, or a half-written calibration.
TEST_F(LifeTest, AJobThatCannotSucceedFailsWithItsFaults) {
  Import(client_, "arm", Uuid(1), MeasuringSession(2, 1));
  ASSERT_THAT(client_.CreateCalibrationJob(JobRequest(Uuid(2), "arm", Uuid(1))), IsOk());
  const auto job = client::WaitForJob(client_, absl::StrCat("jobs/", Uuid(2)));
  ASSERT_THAT(job, IsOk());
  EXPECT_EQ(job->state(), v1::FAILED);
  EXPECT_NE(job->error().code(), 0);
  EXPECT_NE(job->error().message(), "");
  EXPECT_EQ(job->calibration(), "");
  v1::ListCalibrationsRequest request;
  request.set_robot("robots/arm");
  EXPECT_EQ(client_.ListCalibrations(request)->calibrations_size(), 0);
}

// Would catch a page of readings that the real client can't walk.
TEST_F(LifeTest, ReadingsComeBackAsTheyWereSent) {
  const auto input = MeasuringSession(75, 1);
  Import(client_, "arm", Uuid(1), input);
  v1::ListReadingsRequest request;
  request.set_session(absl::StrCat("sessions/", Uuid(1)));
  request.set_page_size(20);
  int row = 0;
  const auto status = client::ForEachPage(
      request, [&](const auto& r) { return client_.ListReadings(r); },
      [&](const v1::ListReadingsResponse& page) {
        for (v1::Reading reading : page.readings()) {
          EXPECT_TRUE(reading.has_server_time());
          reading.clear_server_time();
          EXPECT_EQ(reading.SerializeAsString(), input.readings(row++).SerializeAsString());
        }
        return absl::OkStatus();
      });
  EXPECT_THAT(status, IsOk());
  EXPECT_EQ(row, 75);
}

}  // namespace
}  // namespace truepose
