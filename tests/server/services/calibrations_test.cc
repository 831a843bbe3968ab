#include "server/services/calibrations.h"

#include "absl/strings/str_cat.h"
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
using testing::Parse;
using Fields = std::vector<std::string>;

class CalibrationsTest : public HandlerTest {
 protected:
  CalibrationsTest() {
    AddRobot("ur10");
    AddSealedSession(kSession1, "ur10", 30);
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
  EXPECT_THAT(*got,
              HasFields(absl::StrCat(R"pb(name: "robots/ur10/calibrations/1" job: "jobs/)pb", kJob1,
                                     R"pb("
                                          covariance: 1e-8
                                          residuals { before_position_mm: 1.0 })pb")));
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
  AddCalibration("ur10", kSession1, kJob2);
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

v1::CompensateRequest OneTarget() {
  return Parse<v1::CompensateRequest>(R"pb(
    calibration: "robots/ur10/calibrations/1"
    targets { row: 7 joints: 0.1 joints: -1.2 joints: 1.3 joints: 0.4 joints: 0.9 joints: 0.2 })pb");
}

// Would catch a compensation that loses rows or returns the target as it was: dq2 is 1 mrad off.
TEST_F(CalibrationsTest, CompensateCorrectsJointTargets) {
  const auto reply = Compensate(call(), OneTarget());
  ASSERT_THAT(reply, IsOk());
  ASSERT_EQ(reply->targets_size(), 1);
  EXPECT_EQ(reply->targets(0).row(), 7);
  EXPECT_EQ(reply->targets(0).fault(), "");
  ASSERT_EQ(reply->targets(0).joints_size(), 6);
  EXPECT_NEAR(reply->targets(0).joints(1), -1.2 - 0.001, 1e-9);
}

TEST_F(CalibrationsTest, CompensateTellsUnknownFromMalformed) {
  auto request = OneTarget();
  request.set_calibration("robots/ur10/calibrations/9");
  EXPECT_THAT(Compensate(call(), request), HasCode(absl::StatusCode::kNotFound));
  request.set_calibration("9");
  EXPECT_THAT(Compensate(call(), request), HasFaultsAt(Fields{"calibration"}));
}

// Would catch a call that computes for minutes.
TEST_F(CalibrationsTest, CompensateBoundsTheTargets) {
  auto request = OneTarget();
  for (int i = 0; i < kMostTargets; ++i) request.add_targets();
  EXPECT_THAT(Compensate(call(), request), HasFaultsAt(Fields{"targets"}));
}

}  // namespace
}  // namespace truepose::services
