// Requests of jobs that are repeated with their id got the state of now instead of the first
// answer: a cancellation looked up no id at all, and a creation looked at robot and sessions before
// it looked whether it had been answered.
#include "server/jobs/transitions.h"
#include "server/services/jobs.h"
#include "server/services/robots.h"
#include "tests/server/testing/handler_test.h"

namespace truepose::services {
namespace {

using testing::IsOk;
using testing::Parse;

class RepeatedJobRequests : public testing::HandlerTest {
 protected:
  RepeatedJobRequests() {
    AddRobot("ur10");
    AddSealedSession(testing::kSession1, "ur10");
    request_.set_job_id(testing::kJob1);
    request_.set_robot("robots/ur10");
    request_.add_sessions(std::string("sessions/") + testing::kSession1);
    request_.set_request_id(testing::kSession2);
  }

  v1::CreateCalibrationJobRequest request_;
};

// Would catch an answer that tells how the cancelled job has ended meanwhile.
TEST_F(RepeatedJobRequests, ACancellationIsAnsweredOnce) {
  ASSERT_THAT(CreateCalibrationJob(call(), request_), IsOk());
  ASSERT_THAT(store().Write([](store::Transaction& t) { return jobs::ClaimNext(t); }), IsOk());
  v1::CancelCalibrationJobRequest cancel;
  cancel.set_name(std::string("jobs/") + testing::kJob1);
  cancel.set_request_id(testing::kSession1);
  const auto first = CancelCalibrationJob(call(), cancel);
  ASSERT_THAT(first, IsOk());
  EXPECT_EQ(first->state(), v1::RUNNING);
  ASSERT_THAT(store().Write([](store::Transaction& t) { return jobs::RecoverRunning(t, 3); }),
              IsOk());
  const auto again = CancelCalibrationJob(call(), cancel);
  ASSERT_THAT(again, IsOk());
  EXPECT_EQ(again->SerializeAsString(), first->SerializeAsString());
}

// Would catch a repeat that is refused for what happened after the first answer.
TEST_F(RepeatedJobRequests, ACreationIsAnsweredAlsoWhenItsRobotIsGone) {
  const auto first = CreateCalibrationJob(call(), request_);
  ASSERT_THAT(first, IsOk());
  v1::CancelCalibrationJobRequest cancel;
  cancel.set_name(first->name());
  ASSERT_THAT(CancelCalibrationJob(call(), cancel), IsOk());
  ASSERT_THAT(DeleteRobot(call(), Parse<v1::DeleteRobotRequest>(R"pb(name: "robots/ur10")pb")),
              IsOk());
  const auto again = CreateCalibrationJob(call(), request_);
  ASSERT_THAT(again, IsOk());
  EXPECT_EQ(again->SerializeAsString(), first->SerializeAsString());
}

}  // namespace
}  // namespace truepose::services
