#include "tests/integration/server_fixture.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "client/append_readings.h"
#include "server/calibration_runner.h"
#include "tests/server/testing/expect_status.h"

namespace truepose::testing {

v1::SessionInput MeasuringSession(int poses, unsigned seed) {
  convert::SimulationOptions options;
  options.poses = poses;
  options.seed = seed;
  const auto simulation = convert::RunSimulation(convert::MeasuringRobot(), options);
  EXPECT_THAT(simulation, IsOk());
  return simulation.ok() ? simulation->session : v1::SessionInput();
}

std::string Uuid(int number) { return absl::StrFormat("00000000-0000-4000-8000-%012d", number); }

void Import(const client::Client& client, const std::string& robot_id,
            const std::string& session_id, const v1::SessionInput& input) {
  v1::CreateRobotRequest robot;
  robot.set_robot_id(robot_id);
  *robot.mutable_nominal() = convert::MeasuringRobot();
  ASSERT_THAT(client.CreateRobot(robot), IsOk());
  v1::CreateSessionRequest session;
  session.set_session_id(session_id);
  session.mutable_session()->set_robot(absl::StrCat("robots/", robot_id));
  ASSERT_THAT(client.CreateSession(session), IsOk());
  const std::string name = absl::StrCat("sessions/", session_id);
  const std::vector<v1::Reading> readings(input.readings().begin(), input.readings().end());
  ASSERT_THAT(client::AppendReadings(client, name, readings, {.batch_size = 50}), IsOk());
  v1::SealSessionRequest seal;
  seal.set_name(name);
  seal.set_reading_count(static_cast<int>(readings.size()));
  ASSERT_THAT(client.SealSession(seal), IsOk());
}

v1::CreateCalibrationJobRequest JobRequest(const std::string& job_id, const std::string& robot_id,
                                           const std::string& session_id) {
  v1::CreateCalibrationJobRequest request;
  request.set_job_id(job_id);
  request.set_robot(absl::StrCat("robots/", robot_id));
  request.add_sessions(absl::StrCat("sessions/", session_id));
  request.mutable_options()->set_split("even-odd");
  return request;
}

absl::StatusOr<jobs::BuiltTable> SmallTable(const v1::CompensationTableInput& input,
                                            const jobs::RunnerHooks& hooks) {
  v1::JobProgress progress;
  progress.set_stage("nodes");
  progress.set_fraction(0.5);
  hooks.on_progress(progress);
  jobs::BuiltTable built;
  built.header.set_schema_version(1);
  built.header.set_robot(input.robot());
  built.header.set_calibration(input.calibration().name());
  built.header.set_calibration_digest(input.calibration().digest());
  const std::string line =
      absl::StrCat(input.calibration().digest(), " ", input.spec().seed(), "\n");
  while (built.bytes.size() < 600'000) built.bytes += line;
  return built;
}

ServerFixture::ServerFixture()
    : runner_(server::CalibrationRunner(), SmallTable, [](const v1::CompensationTableInput&) {
        v1::CompensationTableEstimate estimate;
        estimate.set_size_bytes(600'000);
        return estimate;
      }) {
  options_.listen = absl::StrCat("unix:", folder_.File("s.sock"));
  options_.database = folder_.File("t.db");
  options_.dev_open = true;  // tests of tokens: authenticated_fixture.h
  Restart();
}

void ServerFixture::Restart() {
  server_.reset();
  auto server = server::Server::Start(options_, runner_);
  ASSERT_THAT(server, IsOk());
  server_ = *std::move(server);
}

client::Client ServerFixture::NewClient() const {
  auto client = client::Client::Connect(options_.listen);
  EXPECT_THAT(client, IsOk());
  return *std::move(client);
}

}  // namespace truepose::testing
