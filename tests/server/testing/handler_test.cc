#include "tests/server/testing/handler_test.h"

#include <future>
#include <utility>

#include "absl/strings/str_cat.h"
#include "convert/run.h"
#include "server/services/jobs.h"
#include "server/services/robots.h"
#include "server/services/sessions.h"
#include "server/store/calibrations.h"

namespace truepose::testing {

absl::StatusOr<v1::AppendReadingsResponse> AppendAndWait(services::AppendStream& stream,
                                                         const v1::AppendReadingsRequest& request) {
  std::promise<absl::StatusOr<v1::AppendReadingsResponse>> answer;
  stream.Append(request, [&](absl::StatusOr<v1::AppendReadingsResponse> acknowledgement) {
    answer.set_value(std::move(acknowledgement));
  });
  return answer.get_future().get();
}
namespace {

// Made once by a real calibration, since evaluation and compensation look into it.
const v1::Calibration& ExampleCalibration() {
  static const auto& calibration = *new v1::Calibration([] {
    v1::CalibrationInput input;
    *input.mutable_nominal() = SixAxes();
    *input.add_sessions() = SimulatedSession(kCalibrationPoses, 1);
    const auto result = convert::RunCalibration(input);
    EXPECT_THAT(result, IsOk());
    return result.value_or(v1::Calibration());
  }());
  return calibration;
}

}  // namespace

HandlerTest::HandlerTest(const store::Clock* clock) {
  auto store = store::Store::Open({.path = ":memory:", .clock = clock});
  EXPECT_THAT(store, IsOk());
  store_ = *std::move(store);
  const jobs::Runner never = [](const v1::CalibrationInput&, const jobs::RunnerHooks&) {
    return absl::InternalError("no job runs in tests of handlers");
  };
  engine_ =
      std::make_unique<jobs::JobEngine>(*store_, never, jobs::EngineOptions(), store_->clock());
  call_.reset(new services::CallContext{*store_, *engine_});
}

absl::StatusOr<v1::AppendReadingsResponse> HandlerTest::Append(
    const v1::AppendReadingsRequest& request) const {
  services::AppendStream stream(call());
  return AppendAndWait(stream, request);
}

void HandlerTest::AddRobot(const std::string& robot_id) {
  ASSERT_THAT(services::CreateRobot(call(), RobotRequest(robot_id)), IsOk());
}

void HandlerTest::AddSession(const std::string& session_id, const std::string& robot_id,
                             int readings) {
  ASSERT_THAT(services::CreateSession(
                  call(), SessionRequest(session_id, absl::StrCat("robots/", robot_id))),
              IsOk());
  ASSERT_THAT(Append(Batch(session_id, 0, readings)), IsOk());
}

void HandlerTest::AddSimulatedSession(const std::string& session_id, const std::string& robot_id,
                                      int poses) {
  ASSERT_THAT(services::CreateSession(
                  call(), SessionRequest(session_id, absl::StrCat("robots/", robot_id))),
              IsOk());
  AddReadingsAndSeal(session_id, poses);
}

void HandlerTest::AddReadingsAndSeal(const std::string& session_id, int poses) {
  v1::AppendReadingsRequest batch;
  batch.set_session(absl::StrCat("sessions/", session_id));
  *batch.mutable_readings() = SimulatedSession(poses, 1).readings();
  ASSERT_THAT(Append(batch), IsOk());
  CloseSession(session_id, poses);
}

void HandlerTest::AddSealedSession(const std::string& session_id, const std::string& robot_id,
                                   int readings) {
  AddSession(session_id, robot_id, readings);
  CloseSession(session_id, readings);
}

void HandlerTest::CloseSession(const std::string& session_id, int readings) {
  v1::SealSessionRequest request;
  request.set_name(absl::StrCat("sessions/", session_id));
  request.set_reading_count(readings);
  ASSERT_THAT(services::SealSession(call(), request), IsOk());
}

v1::Calibration HandlerTest::AddCalibration(const std::string& robot_id,
                                            const std::string& session_id,
                                            const std::string& job_id) {
  v1::CreateCalibrationJobRequest request;
  request.set_job_id(job_id);
  request.set_robot(absl::StrCat("robots/", robot_id));
  request.add_sessions(absl::StrCat("sessions/", session_id));
  const auto job = services::CreateCalibrationJob(call(), request);
  EXPECT_THAT(job, IsOk());
  v1::Calibration calibration = ExampleCalibration();
  calibration.set_nominal_revision(job->nominal_revision());
  *calibration.mutable_sessions() = job->sessions();
  // Equal content would be stored once.
  calibration.mutable_report()->add_warnings(absl::StrCat("of ", job_id));
  const auto stored = store_->Write([&](store::Transaction& transaction) {
    return store::InsertCalibration(transaction, *job, calibration);
  });
  EXPECT_THAT(stored, IsOk());
  return stored.value_or(v1::Calibration());
}

}  // namespace truepose::testing
