#include "client/agent/requests/next_step.h"

#include "gtest/gtest.h"

namespace truepose::agent {
namespace {

constexpr char kSession[] = "sessions/one";

OpenRequest In(v1::RecalibrationState state) {
  OpenRequest open;
  open.request.set_name("robots/arm/recalibrationRequests/r");
  open.request.set_state(state);
  open.request.set_pose_set("robots/arm/poseSets/p");
  open.has_poses = true;
  return open;
}

void AddStep(OpenRequest& open, v1::RecalibrationState state, const std::string& reason) {
  v1::RecalibrationStep& step = *open.request.add_steps();
  step.set_state(state);
  step.set_reason(reason);
}

OpenRequest Measuring(int reported) {
  OpenRequest open = In(v1::REQUEST_MEASURING);
  open.session = kSession;
  open.request.set_session(kSession);
  open.request.set_readings_taken(reported);
  AddStep(open, v1::REQUEST_MEASURING, kSession);
  return open;
}

// Would catch a request that is taken on without the poses that it wants measured.
TEST(NextStepTest, FetchesThenAcknowledges) {
  OpenRequest open = In(v1::REQUEST_PENDING);
  open.has_poses = false;
  EXPECT_EQ(NextStep(open, {}, {}), StepKind::kFetchPoses);
  open.has_poses = true;
  EXPECT_EQ(NextStep(open, {}, {}), StepKind::kAcknowledge);
  EXPECT_EQ(NextStep(open, {}, {.acknowledge = false}), StepKind::kNone);
  open.session = kSession;
  EXPECT_EQ(NextStep(open, {.delivered = 1}, {.acknowledge = false}), StepKind::kAcknowledge);
}

// Would catch a report of a session that the server doesn't know yet, which it refuses.
TEST(NextStepTest, ReportsOnceReadingsAreThere) {
  OpenRequest open = In(v1::REQUEST_ACKNOWLEDGED);
  EXPECT_EQ(NextStep(open, {}, {}), StepKind::kNone);
  open.session = kSession;
  EXPECT_EQ(NextStep(open, {}, {}), StepKind::kNone);
  EXPECT_EQ(NextStep(open, {.delivered = 1}, {}), StepKind::kReport);
  EXPECT_EQ(NextStep(open, {.settled = true}, {}), StepKind::kReport) << "after a restart";
}

TEST(NextStepTest, ReportsProgressAndCalibratesWhenSealed) {
  EXPECT_EQ(NextStep(Measuring(3), {.delivered = 5}, {}), StepKind::kReport);
  EXPECT_EQ(NextStep(Measuring(5), {.delivered = 5}, {}), StepKind::kNone);
  EXPECT_EQ(NextStep(Measuring(5), {.settled = true}, {}), StepKind::kCalibrate);
  EXPECT_EQ(NextStep(In(v1::REQUEST_CALIBRATING), {.settled = true}, {}), StepKind::kNone);
}

// Would catch jobs without end over a session that can't be calibrated from.
TEST(NextStepTest, AFailedJobIsNotRepeatedOverTheSameSession) {
  OpenRequest open = Measuring(5);
  AddStep(open, v1::REQUEST_CALIBRATING, "");
  AddStep(open, v1::REQUEST_MEASURING, "jobs/j failed");
  EXPECT_EQ(NextStep(open, {.settled = true}, {}), StepKind::kNone);
  open.session = "sessions/two";
  EXPECT_EQ(NextStep(open, {.delivered = 1}, {}), StepKind::kReport);
  open.request.set_session("sessions/two");
  AddStep(open, v1::REQUEST_MEASURING, "sessions/two");
  EXPECT_EQ(NextStep(open, {.settled = true}, {}), StepKind::kCalibrate);
}

// Would catch a no that is not heard once somebody has begun.
TEST(NextStepTest, ANoComesFirst) {
  for (const auto state : {v1::REQUEST_PENDING, v1::REQUEST_MEASURING, v1::REQUEST_CALIBRATING}) {
    OpenRequest open = In(state);
    open.decline_reason = "replaced next week";
    EXPECT_EQ(NextStep(open, {}, {}), StepKind::kDecline);
  }
  OpenRequest ended = In(v1::REQUEST_EXPIRED);
  ended.decline_reason = "too late";
  EXPECT_EQ(NextStep(ended, {}, {}), StepKind::kNone);
}

}  // namespace
}  // namespace truepose::agent
