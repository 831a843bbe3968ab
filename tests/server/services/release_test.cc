#include "server/services/release.h"

#include "core/base/status_macros.h"
#include "server/services/calibrations.h"
#include "server/services/release_rules.h"
#include "server/services/robots.h"
#include "server/store/robots.h"
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
using Fields = std::vector<std::string>;

constexpr char kFirst[] = "robots/ur10/calibrations/1";
constexpr char kSecond[] = "robots/ur10/calibrations/2";

template <typename Request>
Request Named(const std::string& name, const std::string& reason = "") {
  Request request;
  request.set_name(name);
  request.set_reason(reason);
  return request;
}

class ReleaseTest : public HandlerTest {
 protected:
  ReleaseTest() {
    AddRobot("ur10");
    AddSimulatedSession(kSession1, "ur10", testing::kCalibrationPoses);
    AddSimulatedSession(kSession2, "ur10", testing::kCalibrationPoses);
    AddCalibration("ur10", kSession1, kJob1);
    AddCalibration("ur10", kSession2, kJob2);
  }

  CallContext As(const std::string& principal, bool is_machine = false) {
    CallContext context = call();
    context.caller = {
        .principal = principal, .is_machine = is_machine, .is_admin = false, .is_local_dev = false};
    return context;
  }

  void Release(const std::string& name) {
    ASSERT_THAT(ApproveCalibration(As("anna"), Named<v1::ApproveCalibrationRequest>(name, "ok")),
                IsOk());
    ASSERT_THAT(ActivateCalibration(As("anna"), Named<v1::ActivateCalibrationRequest>(name)),
                IsOk());
  }

  v1::ReleaseState StateOf(const std::string& name) {
    v1::GetCalibrationRequest request;
    request.set_name(name);
    return GetCalibration(call(), request)->state();
  }

  std::string Active() {
    v1::GetRobotRequest request;
    request.set_name("robots/ur10");
    return GetRobot(call(), request)->active_calibration();
  }
};

// Would catch a result that acts on a robot before anybody has looked at it.
TEST_F(ReleaseTest, AResultIsADraft) {
  EXPECT_EQ(StateOf(kFirst), v1::DRAFT);
  EXPECT_EQ(Active(), "");
  EXPECT_THAT(ActivateCalibration(As("anna"), Named<v1::ActivateCalibrationRequest>(kFirst)),
              HasCode(absl::StatusCode::kFailedPrecondition));
}

// Would catch a nominal that changes under the limits: the change of the flange between
// calibrations of two nominals can't be told, so a person decides, and the job that asks does not
// fail by it.
TEST_F(ReleaseTest, TheServerReleasesOnlyOverTheSameNominal) {
  Release(kFirst);
  v1::UpdateRobotRequest update;
  update.mutable_robot()->set_name("robots/ur10");
  update.mutable_robot()->set_release_policy(v1::AUTOMATIC_WITHIN_LIMITS);
  update.mutable_robot()->mutable_limits()->set_control_rms_mm(1'000);
  ASSERT_THAT(UpdateRobot(call(), update), IsOk());
  v1::Calibration good = *GetCalibration(call(), [] {
    v1::GetCalibrationRequest request;
    request.set_name(kSecond);
    return request;
  }());
  good.mutable_report()->set_verdict("apply");
  good.mutable_report()->mutable_sets()->mutable_control()->set_poses(20);
  const auto release = [&](bool keep) {
    return store().Write([&](store::Transaction& transaction) -> absl::StatusOr<std::string> {
      TRUEPOSE_RETURN_IF_ERROR(ReleaseWithinLimits(transaction, good));
      TRUEPOSE_ASSIGN_OR_RETURN(const auto robot, store::GetRobot(transaction, "robots/ur10"));
      if (!keep) return absl::AbortedError(robot.active_calibration());
      return robot.active_calibration();
    });
  };
  EXPECT_EQ(release(false).status().message(), kSecond) << "over the same nominal it does";
  v1::CreateNominalRevisionRequest revision;
  revision.set_parent("robots/ur10");
  *revision.mutable_nominal() = testing::SixAxes("2");
  ASSERT_THAT(CreateNominalRevision(call(), revision), IsOk());
  good.set_nominal_revision("robots/ur10/nominals/2");
  const auto active = release(true);
  ASSERT_THAT(active, IsOk());
  EXPECT_EQ(*active, kFirst);
}

// Would catch a machine that releases, or one person where two are asked for, by way of the policy.
TEST_F(ReleaseTest, OnlyAnAdminSetsHowItIsReleased) {
  v1::UpdateRobotRequest request;
  request.mutable_robot()->set_name("robots/ur10");
  request.mutable_robot()->set_display_name("cell 7");
  EXPECT_THAT(UpdateRobot(As("anna"), request), IsOk());
  request.mutable_robot()->set_release_policy(v1::ONE_PERSON);
  EXPECT_THAT(UpdateRobot(As("anna"), request), HasCode(absl::StatusCode::kPermissionDenied));
  request.mutable_robot()->clear_release_policy();
  request.mutable_robot()->mutable_limits()->set_change_mm(100);
  EXPECT_THAT(UpdateRobot(As("agent", true), request),
              HasCode(absl::StatusCode::kPermissionDenied));
  EXPECT_THAT(UpdateRobot(call(), request), IsOk()) << "who is an admin here";
}

// Would catch two active calibrations of a robot, or a step that is forgotten.
TEST_F(ReleaseTest, OneIsActiveAndTheStepsStay) {
  Release(kFirst);
  Release(kSecond);
  EXPECT_EQ(StateOf(kFirst), v1::SUPERSEDED);
  EXPECT_EQ(StateOf(kSecond), v1::ACTIVE);
  EXPECT_EQ(Active(), kSecond);
  v1::GetCalibrationRequest request;
  request.set_name(kFirst);
  const auto first = GetCalibration(call(), request);
  ASSERT_THAT(first, IsOk());
  std::vector<v1::ReleaseState> states;
  for (const v1::ReleaseStep& step : first->release_steps()) states.push_back(step.state());
  EXPECT_EQ(states,
            (std::vector<v1::ReleaseState>{v1::DRAFT, v1::APPROVED, v1::ACTIVE, v1::SUPERSEDED}));
  EXPECT_EQ(first->release_steps(1).principal(), "anna");
  EXPECT_EQ(first->release_steps(1).reason(), "ok");
}

// Would catch a roll back that goes to the wrong one, or forgets what it left.
TEST_F(ReleaseTest, RollBackGoesToTheOneBefore) {
  Release(kFirst);
  v1::RollBackCalibrationRequest request;
  request.set_robot("robots/ur10");
  EXPECT_THAT(RollBackCalibration(As("anna"), request),
              HasCode(absl::StatusCode::kFailedPrecondition));
  Release(kSecond);
  request.set_from(kFirst);
  EXPECT_THAT(RollBackCalibration(As("anna"), request),
              HasCode(absl::StatusCode::kFailedPrecondition));
  request.set_from(kSecond);
  const auto back = RollBackCalibration(As("ben"), request);
  ASSERT_THAT(back, IsOk());
  EXPECT_EQ(back->name(), kFirst);
  EXPECT_EQ(Active(), kFirst);
  EXPECT_EQ(StateOf(kSecond), v1::SUPERSEDED);
}

// Would catch a machine that releases, and a rejected calibration that comes back.
TEST_F(ReleaseTest, MachinesReleaseNothingAndRejectedStaysRejected) {
  EXPECT_THAT(
      ApproveCalibration(As("agent", true), Named<v1::ApproveCalibrationRequest>(kFirst, "ok")),
      HasCode(absl::StatusCode::kPermissionDenied));
  EXPECT_THAT(RejectCalibration(As("anna"), Named<v1::RejectCalibrationRequest>(kFirst)),
              HasFaultsAt(Fields{"reason"}));
  ASSERT_THAT(
      RejectCalibration(As("anna"), Named<v1::RejectCalibrationRequest>(kFirst, "loose target")),
      IsOk());
  EXPECT_THAT(ApproveCalibration(As("anna"), Named<v1::ApproveCalibrationRequest>(kFirst, "ok")),
              HasCode(absl::StatusCode::kFailedPrecondition));
}

Origin MadeBy(const std::string& creator, bool machine, const std::string& sealer) {
  Origin origin;
  origin.job.set_created_by(creator);
  origin.job.set_created_by_machine(machine);
  origin.sessions.emplace_back().set_sealed_by(sealer);
  return origin;
}

Caller Person(const std::string& name) {
  return {.principal = name, .is_machine = false, .is_admin = false, .is_local_dev = false};
}

// Would catch one person who measures, calibrates and releases.
TEST(ReleaseRules, TwoPersonsUnlessAMachineMadeTheJob) {
  v1::Robot robot;
  const auto may = [&](const std::string& who, const Origin& origin) {
    return CheckMayApprove(Person(who), robot, origin).ok();
  };
  EXPECT_FALSE(may("anna", MadeBy("anna", false, "ben")));
  EXPECT_FALSE(may("ben", MadeBy("anna", false, "ben")));
  EXPECT_TRUE(may("carl", MadeBy("anna", false, "ben")));
  EXPECT_TRUE(may("anna", MadeBy("agent", true, "agent")));
  robot.set_release_policy(v1::ONE_PERSON);
  EXPECT_TRUE(may("anna", MadeBy("anna", false, "anna")));
}

// Would catch a result that is approved, whatever the reason, and that neither compensation nor a
// table then takes: the robot would go on with another set than the server names.
TEST(ReleaseRules, DoNotApplyIsNotApproved) {
  v1::Calibration calibration;
  calibration.mutable_report()->set_verdict("do_not_apply");
  EXPECT_FALSE(CheckVerdict(calibration).ok());
  calibration.mutable_report()->set_verdict("apply_within_volume");
  EXPECT_TRUE(CheckVerdict(calibration).ok());
}

// Would catch a limit that doesn't hold, each alone.
TEST(ReleaseRules, AutomaticStaysWithinEveryLimit) {
  v1::Robot robot;
  robot.set_release_policy(v1::AUTOMATIC_WITHIN_LIMITS);
  robot.mutable_limits()->set_control_rms_mm(0.5);
  robot.mutable_limits()->set_change_mm(1.0);
  v1::Calibration good;
  good.mutable_report()->set_verdict("apply");
  v1::SetReport& control = *good.mutable_report()->mutable_sets()->mutable_control();
  control.set_poses(20);
  control.mutable_after()->mutable_position_mm()->set_rms(0.4);
  EXPECT_EQ(WhyNotAutomatic(robot, good, 0.9), "");
  EXPECT_EQ(WhyNotAutomatic(robot, good, -1.0), "");
  EXPECT_NE(WhyNotAutomatic(robot, good, 1.1), "");
  control.mutable_after()->mutable_position_mm()->set_rms(0.6);
  EXPECT_NE(WhyNotAutomatic(robot, good, 0.9), "");
  control.mutable_after()->mutable_position_mm()->set_rms(0.4);
  good.mutable_report()->set_verdict("apply_within_volume");
  EXPECT_NE(WhyNotAutomatic(robot, good, 0.9), "");
  good.mutable_report()->set_verdict("apply");
  robot.mutable_limits()->set_control_rms_mm(0);
  EXPECT_NE(WhyNotAutomatic(robot, good, 0.9), "");
}

}  // namespace
}  // namespace truepose::services
