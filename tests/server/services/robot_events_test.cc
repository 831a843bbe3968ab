#include "server/services/robot_events.h"

#include "absl/strings/str_format.h"
#include "server/services/sessions.h"
#include "tests/server/services/recalibration_testing.h"

namespace truepose::services {
namespace {

using testing::HasCode;
using testing::HasFaultsAt;
using testing::HasFields;
using testing::IsOk;
using testing::kSession2;
using Fields = std::vector<std::string>;

std::string EventId(int number) {
  return absl::StrFormat("00000000-0000-4000-8000-0000000000e%d", number);
}

class RobotEventsTest : public RecalibrationFixture {
 protected:
  RobotEventsTest() { clock_.Advance(absl::Hours(1)); }

  absl::StatusOr<v1::RobotEvent> Report(int number, const std::string& content,
                                        bool validate_only = false) {
    v1::CreateRobotEventRequest request;
    request.set_parent(kRobot);
    request.set_robot_event_id(EventId(number));
    request.set_validate_only(validate_only);
    *request.mutable_robot_event() = testing::Parse<v1::RobotEvent>(content);
    return CreateRobotEvent(As("agent", true), request);
  }

  void Heat(int number, double temperature_c) {
    EXPECT_THAT(
        Report(number, absl::StrFormat("kind: TEMPERATURE temperature_c: %g", temperature_c)),
        IsOk());
  }
};

// Would catch a collision that nobody acts on, and one that raises two requests when it is told
// again.
TEST_F(RobotEventsTest, AnEventOfThePolicyRaisesOneRequest) {
  SetPolicy("event_kinds: [COLLISION, MOTOR_CHANGE] poses: 25");
  const auto event = Report(1, "kind: MOTOR_CHANGE joint: 3 description: 'new gear'");
  ASSERT_THAT(event, IsOk());
  EXPECT_EQ(event->created_by(), "agent");
  EXPECT_THAT(Open(), HasFields(absl::StrCat("cause: CAUSE_EVENT created_by: 'server' raised_by: '",
                                             event->name(),
                                             "' reason: 'MOTOR_CHANGE of joint 3: new gear'")));
  const auto poses = All<v1::PoseSet>();
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_EQ(poses[0].poses_size(), 25);
  ASSERT_THAT(Report(1, "kind: MOTOR_CHANGE joint: 3 description: 'new gear'"), IsOk());
  EXPECT_EQ(All<v1::RecalibrationRequest>().size(), 1u);
}

// Would catch an input that chatters and makes a request, which is told whole, grow without end.
TEST_F(RobotEventsTest, ARequestNotesOnlySoMany) {
  SetPolicy("event_kinds: COLLISION");
  for (int i = 0; i < 120; ++i) {
    v1::CreateRobotEventRequest request;
    request.set_parent(kRobot);
    request.set_robot_event_id(absl::StrFormat("00000000-0000-4000-8000-0000000000%02x", i + 100));
    *request.mutable_robot_event() = testing::Parse<v1::RobotEvent>("kind: COLLISION");
    ASSERT_THAT(CreateRobotEvent(As("agent", true), request), IsOk());
  }
  EXPECT_EQ(All<v1::RecalibrationRequest>().at(0).steps_size(), 100);
}

// Would catch a second request, or an event that the open one keeps silent about.
TEST_F(RobotEventsTest, AnEventIsNotedInTheOpenRequest) {
  SetPolicy("event_kinds: COLLISION");
  ASSERT_THAT(Ask(kRequest1), IsOk());
  ASSERT_THAT(Report(1, "kind: COLLISION description: 'the fixture'"), IsOk());
  const v1::RecalibrationRequest open = Open();
  EXPECT_EQ(open.name(), RequestName(kRequest1));
  ASSERT_EQ(open.steps_size(), 2);
  EXPECT_EQ(open.steps(1).reason(), "also: COLLISION: the fixture");
  EXPECT_EQ(open.state(), v1::REQUEST_PENDING);
}

// Would catch requests that no policy asks for, or for what happened before the robot was measured.
TEST_F(RobotEventsTest, OtherEventsRaiseNothing) {
  ASSERT_THAT(Report(1, "kind: COLLISION"), IsOk());
  SetPolicy("event_kinds: COLLISION");
  ASSERT_THAT(Report(2, "kind: NOTE description: 'painted'"), IsOk());
  ASSERT_THAT(Report(3, "kind: COLLISION event_time { seconds: 1000 }"), IsOk());
  ASSERT_THAT(Report(4, "kind: COLLISION", true), IsOk());
  EXPECT_TRUE(All<v1::RecalibrationRequest>().empty());
  EXPECT_EQ(All<v1::RobotEvent>().size(), 3u);
}

// Would catch a joint that the robot does not have, and a clock that runs years ahead.
TEST_F(RobotEventsTest, FaultsOfEvents) {
  const int64_t ahead = absl::ToUnixSeconds(clock_.Now()) + 3'600;
  EXPECT_THAT(
      Report(1, absl::StrCat("kind: MOTOR_CHANGE joint: 7 event_time { seconds: ", ahead, "}")),
      HasFaultsAt(Fields{"robot_event.event_time", "robot_event.joint"}));
  EXPECT_THAT(Report(1, "kind: MOTOR_CHANGE joint: 6"), IsOk());
}

// Would catch a policy whose poses are another robot's, or were deleted, both at its making and
// later.
TEST_F(RobotEventsTest, APolicysPosesAreTheRobots) {
  AddRobot("other");
  v1::CreateRecalibrationPolicyRequest request;
  request.set_parent(kRobot);
  request.set_recalibration_policy_id("default");
  v1::RecalibrationPolicy& content = *request.mutable_recalibration_policy();
  content.set_pose_set(AddPoseSet("theirs", "robots/other"));
  v1::RecalibrationPolicy policy;
  EXPECT_THAT(CreateStandard(call(), request, policy),
              HasFaultsAt(Fields{"recalibration_policy.pose_set"}));
  content.set_pose_set(AddPoseSet("own"));
  ASSERT_THAT(CreateStandard(call(), request, policy), IsOk());
  v1::UpdateRecalibrationPolicyRequest update;
  *update.mutable_recalibration_policy() = policy;
  update.mutable_recalibration_policy()->set_pose_set("robots/ur10/poseSets/none");
  update.mutable_update_mask()->add_paths("pose_set");
  EXPECT_THAT(UpdateStandard(call(), update, policy),
              HasFaultsAt(Fields{"recalibration_policy.pose_set"}));
}

// Would catch a policy that raises a request for each report of a temperature, or names a pose set
// that is none.
TEST_F(RobotEventsTest, FaultsOfPolicies) {
  v1::CreateRecalibrationPolicyRequest request;
  request.set_parent(kRobot);
  request.set_recalibration_policy_id("default");
  *request.mutable_recalibration_policy() =
      testing::Parse<v1::RecalibrationPolicy>("event_kinds: TEMPERATURE pose_set: 'poses.csv'");
  v1::RecalibrationPolicy policy;
  EXPECT_THAT(
      CreateStandard(call(), request, policy),
      HasFaultsAt(Fields{"recalibration_policy.event_kinds[0]", "recalibration_policy.pose_set"}));
}

// Would catch a step that is counted from nowhere, and a request for each of the reports of one
// warm day.
TEST_F(RobotEventsTest, ATemperatureStepRaisesOnce) {
  SetPolicy("temperature_step_k: 5");
  Heat(1, 40);  // nothing to compare with
  EXPECT_TRUE(All<v1::RecalibrationRequest>().empty());
  v1::CreateSessionRequest session = testing::SessionRequest(kSession2, kRobot);
  session.mutable_session()->set_temperature_c(20);
  ASSERT_THAT(CreateSession(call(), session), IsOk());
  AddReadingsAndSeal(kSession2, testing::kCalibrationPoses);
  Activate(AddCalibration("ur10", kSession2, testing::kJob2).name());
  clock_.Advance(absl::Hours(1));
  Heat(2, 24.9);
  EXPECT_EQ(Open().name(), "");
  Heat(3, 25.5);
  const v1::RecalibrationRequest open = Open();
  EXPECT_THAT(open, HasFields("cause: CAUSE_TEMPERATURE reason: '25.5 C at the robot, 20.0 C when "
                              "it was calibrated'"));
  v1::DeclineRecalibrationRequest decline;
  decline.set_name(open.name());
  decline.set_reason("it is a hot day");
  ASSERT_THAT(DeclineRecalibration(call(), decline), IsOk());
  Heat(4, 26);
  EXPECT_EQ(Open().name(), "") << "somebody has heard of it";
  Heat(5, 31);
  EXPECT_NE(Open().name(), "") << "as far again";
}

}  // namespace
}  // namespace truepose::services
