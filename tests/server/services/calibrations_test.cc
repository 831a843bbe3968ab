#include "server/services/calibrations.h"

#include "absl/strings/str_cat.h"
#include "convert/run.h"
#include "server/services/jobs.h"
#include "server/services/robots.h"
#include "server/store/release.h"
#include "tests/server/testing/handler_test.h"

namespace truepose::services {
namespace {

using testing::HandlerTest;
using testing::HasCode;
using testing::HasFaultsAt;
using testing::IsOk;
using testing::kJob1;
using testing::kJob2;
using testing::kSession1;
using testing::kSession2;
using testing::Parse;
using Fields = std::vector<std::string>;

class CalibrationsTest : public HandlerTest {
 protected:
  CalibrationsTest() {
    AddRobot("ur10");
    AddSimulatedSession(kSession1, "ur10", 30);
    AddCalibration("ur10", kSession1, kJob1);
  }
};

v1::EvaluateRequest EvaluationOf(const std::string& calibration, const std::string& session_id) {
  v1::EvaluateRequest request;
  request.set_calibration(calibration);
  request.set_session(absl::StrCat("sessions/", session_id));
  return request;
}

// Would catch a result without its number, or one that lost its residuals.
TEST_F(CalibrationsTest, GetReturnsTheWholeResult) {
  const auto got = GetCalibration(
      call(), Parse<v1::GetCalibrationRequest>(R"pb(name: "robots/ur10/calibrations/1")pb"));
  ASSERT_THAT(got, IsOk());
  EXPECT_EQ(got->name(), "robots/ur10/calibrations/1");
  EXPECT_EQ(got->job(), absl::StrCat("jobs/", kJob1));
  EXPECT_EQ(got->residuals_size(), testing::kCalibrationPoses);
  EXPECT_GT(got->covariance_size(), 0);
}

TEST_F(CalibrationsTest, GetTellsUnknownFromMalformed) {
  const auto unknown =
      Parse<v1::GetCalibrationRequest>(R"pb(name: "robots/ur10/calibrations/9")pb");
  EXPECT_THAT(GetCalibration(call(), unknown), HasCode(absl::StatusCode::kNotFound));
  const auto malformed = Parse<v1::GetCalibrationRequest>(R"pb(name: "robots/ur10")pb");
  EXPECT_THAT(GetCalibration(call(), malformed), HasFaultsAt(Fields{"name"}));
}

// Would catch a list that carries megabytes of residuals, or the wrong order.
TEST_F(CalibrationsTest, ListIsNewestFirstWithoutResiduals) {
  AddSimulatedSession(kSession2, "ur10", testing::kCalibrationPoses);
  AddCalibration("ur10", kSession2, kJob2);
  const auto listed =
      ListCalibrations(call(), Parse<v1::ListCalibrationsRequest>(R"pb(robot: "robots/ur10")pb"));
  ASSERT_THAT(listed, IsOk());
  ASSERT_EQ(listed->calibrations_size(), 2);
  EXPECT_EQ(listed->calibrations(0).name(), "robots/ur10/calibrations/2");
  EXPECT_EQ(listed->calibrations(0).residuals_size(), 0);
  EXPECT_EQ(listed->calibrations(0).covariance_size(), 0);
}

TEST_F(CalibrationsTest, ListTellsUnknownFromMalformed) {
  EXPECT_THAT(
      ListCalibrations(call(), Parse<v1::ListCalibrationsRequest>(R"pb(robot: "robots/none")pb")),
      HasCode(absl::StatusCode::kNotFound));
  EXPECT_THAT(ListCalibrations(call(), {}), HasFaultsAt(Fields{"robot"}));
}

TEST_F(CalibrationsTest, EvaluateNamesEveryFault) {
  auto request = EvaluationOf("ur10#1", "1");
  request.set_observe(static_cast<v1::Observe>(99));
  EXPECT_THAT(Evaluate(call(), request), HasFaultsAt(Fields{"calibration", "session", "observe"}));
}

TEST_F(CalibrationsTest, EvaluateNeedsCalibrationAndSession) {
  EXPECT_THAT(Evaluate(call(), EvaluationOf("robots/ur10/calibrations/9", kSession1)),
              HasCode(absl::StatusCode::kNotFound));
  EXPECT_THAT(Evaluate(call(), EvaluationOf("robots/ur10/calibrations/1", kSession2)),
              HasCode(absl::StatusCode::kNotFound));
}

// Would catch an evaluation on readings that may still change or that another robot made.
TEST_F(CalibrationsTest, EvaluateRefusesOpenSessionsAndThoseOfOtherRobots) {
  AddRobot("other");
  AddSession(kSession2, "other", 3);
  const auto refused = Evaluate(call(), EvaluationOf("robots/ur10/calibrations/1", kSession2));
  ASSERT_THAT(refused, HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_EQ(testing::FieldsOf(refused.status()), (Fields{"session", "session"}));
}

// Would catch an evaluation of other readings, and one on its own readings that passes for
// independent.
TEST_F(CalibrationsTest, EvaluateAppliesACalibrationToASession) {
  AddSimulatedSession(kSession2, "ur10", 20);
  const auto other = Evaluate(call(), EvaluationOf("robots/ur10/calibrations/1", kSession2));
  ASSERT_THAT(other, IsOk());
  EXPECT_EQ(other->calibration(), "robots/ur10/calibrations/1");
  EXPECT_EQ(other->session(), absl::StrCat("sessions/", kSession2));
  EXPECT_EQ(other->set().poses(), 20);
  EXPECT_LT(other->set().after().position_mm().rms(), other->set().before().position_mm().rms());
  EXPECT_EQ(other->warnings_size(), 0);
  const auto own = Evaluate(call(), EvaluationOf("robots/ur10/calibrations/1", kSession1));
  ASSERT_THAT(own, IsOk());
  EXPECT_EQ(own->warnings_size(), 1);
}

v1::CompensateRequest OneTarget() {
  return Parse<v1::CompensateRequest>(R"pb(
    calibration: "robots/ur10/calibrations/1"
    targets { row: 7 joints: 0.1 joints: -1.2 joints: 1.3 joints: 0.4 joints: 0.9 joints: 0.2 })pb");
}

// Would catch a compensation by another calibration or geometry than the one that is named.
TEST_F(CalibrationsTest, CompensateCorrectsJointTargets) {
  const auto reply = Compensate(call(), OneTarget());
  ASSERT_THAT(reply, IsOk());
  ASSERT_EQ(reply->targets_size(), 1);
  EXPECT_EQ(reply->targets(0).row(), 7);
  EXPECT_EQ(reply->targets(0).fault(), "");
  EXPECT_GT(reply->targets(0).position_correction_mm(), 0.01);
  const auto calibration = GetCalibration(
      call(), Parse<v1::GetCalibrationRequest>(R"pb(name: "robots/ur10/calibrations/1")pb"));
  const auto direct = convert::RunCompensation(testing::SixAxes(), *calibration, OneTarget());
  ASSERT_THAT(direct, IsOk());
  EXPECT_EQ(reply->SerializeAsString(), direct->SerializeAsString());
}

TEST_F(CalibrationsTest, CompensateTellsUnknownFromMalformed) {
  auto request = OneTarget();
  request.set_calibration("robots/ur10/calibrations/9");
  EXPECT_THAT(Compensate(call(), request), HasCode(absl::StatusCode::kNotFound));
  request.set_calibration("9");
  EXPECT_THAT(Compensate(call(), request), HasFaultsAt(Fields{"calibration"}));
}

// Would catch a robot that is moved by what a person has rejected.
TEST_F(CalibrationsTest, CompensateRefusesARejectedCalibration) {
  const auto rejected = call().store.Write([](store::Transaction& transaction) {
    return store::AppendReleaseStep(transaction, "robots/ur10/calibrations/1", v1::REJECTED, "anna",
                                    "loose target");
  });
  ASSERT_THAT(rejected, IsOk());
  const auto refused = Compensate(call(), OneTarget());
  EXPECT_THAT(refused, HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_EQ(testing::FieldsOf(refused.status()), Fields{"calibration"});
}

// Would catch joints for a robot that is gone; brought back it gets them again.
TEST_F(CalibrationsTest, CompensateRefusesADeletedRobot) {
  v1::CancelCalibrationJobRequest cancel;  // no robot goes whose jobs have not ended
  cancel.set_name(absl::StrCat("jobs/", kJob1));
  ASSERT_THAT(CancelCalibrationJob(call(), cancel), IsOk());
  const auto named = Parse<v1::DeleteRobotRequest>(R"pb(name: "robots/ur10")pb");
  ASSERT_THAT(DeleteRobot(call(), named), IsOk());
  const auto refused = Compensate(call(), OneTarget());
  EXPECT_THAT(refused, HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_EQ(testing::FieldsOf(refused.status()), Fields{"calibration"});
  const auto back = Parse<v1::UndeleteRobotRequest>(R"pb(name: "robots/ur10")pb");
  ASSERT_THAT(UndeleteRobot(call(), back), IsOk());
  EXPECT_THAT(Compensate(call(), OneTarget()), IsOk());
}

// Would catch a call that computes for minutes.
TEST_F(CalibrationsTest, CompensateBoundsTheTargets) {
  auto request = OneTarget();
  for (int i = 0; i < kMostTargets; ++i) request.add_targets();
  EXPECT_THAT(Compensate(call(), request), HasFaultsAt(Fields{"targets"}));
}

// Would catch an order that a client can't read, and a session or calibration that is left out.
TEST_F(CalibrationsTest, CompareGivesEachSessionUnderEachCalibration) {
  AddSimulatedSession(kSession2, "ur10", testing::kCalibrationPoses);
  AddCalibration("ur10", kSession2, kJob2);
  v1::CompareCalibrationsRequest request;
  request.add_sessions(std::string("sessions/") + kSession1);
  request.add_sessions(std::string("sessions/") + kSession2);
  request.add_calibrations("robots/ur10/calibrations/1");
  request.add_calibrations("robots/ur10/calibrations/2");
  const auto compared = CompareCalibrations(call(), request);
  ASSERT_THAT(compared, IsOk());
  ASSERT_EQ(compared->evaluations_size(), 4);
  EXPECT_EQ(compared->evaluations(1).session(), request.sessions(0));
  EXPECT_EQ(compared->evaluations(1).calibration(), request.calibrations(1));
  EXPECT_EQ(compared->evaluations(2).session(), request.sessions(1));
  EXPECT_LT(compared->evaluations(0).set().after().position_mm().rms(),
            compared->evaluations(0).set().before().position_mm().rms());
}

TEST_F(CalibrationsTest, CompareNamesEveryFault) {
  v1::CompareCalibrationsRequest request;
  request.add_sessions("yesterday");
  request.add_calibrations("the new one");
  EXPECT_THAT(CompareCalibrations(call(), request),
              HasFaultsAt(Fields{"sessions[0]", "calibrations[0]"}));
}

// Would catch a filter that is ignored.
TEST_F(CalibrationsTest, ListTakesAFilter) {
  v1::ListCalibrationsRequest request;
  request.set_robot("robots/ur10");
  request.set_filter("state = \"DRAFT\"");
  EXPECT_EQ(ListCalibrations(call(), request)->calibrations_size(), 1);
  request.set_filter("state = \"ACTIVE\"");
  EXPECT_EQ(ListCalibrations(call(), request)->calibrations_size(), 0);
}

}  // namespace
}  // namespace truepose::services
