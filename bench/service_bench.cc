// The whole of UR10 series C through a real server: read from its file, imported over a socket into
// a database file, sealed, calibrated (even rows), result fetched. A fresh server and database each
// time, its start included.
#include <benchmark/benchmark.h>

#include <string>

#include "bench/bench_server.h"
#include "bench/shared_problem.h"
#include "client/append_readings.h"
#include "client/client.h"
#include "client/wait_for_job.h"
#include "formats/robot_file.h"
#include "formats/session_file.h"

namespace truepose::bench {
namespace {

constexpr char kSession[] = "6f2c1d8e-0b6a-4c59-9d57-000000000001";
constexpr char kJob[] = "6f2c1d8e-0b6a-4c59-9d57-000000000002";

formats::RobotFile AddRobot(const client::Client& client) {
  formats::RobotFile file =
      Demand(formats::ReadRobotFile(TRUEPOSE_SOURCE_DIR "/deploy/examples/ur10.yaml"));
  v1::CreateRobotRequest request;
  request.set_robot_id(file.robot_id);
  *request.mutable_nominal() = file.nominal;
  Demand(client.CreateRobot(request));
  return file;
}

int Import(const client::Client& client, const formats::RobotFile& robot) {
  const auto file = Demand(
      formats::ReadSessionFile(SharedFolder() + "/data/ipa_ur10/series_C.csv", robot.nominal));
  v1::CreateSessionRequest create;
  create.set_session_id(kSession);
  *create.mutable_session() = file.session;
  create.mutable_session()->set_robot("robots/" + robot.robot_id);
  const std::string name = Demand(client.CreateSession(create)).name();
  v1::SealSessionRequest seal;
  seal.set_name(name);
  seal.set_reading_count(Demand(client::AppendReadings(client, name, file.readings)));
  return Demand(client.SealSession(seal)).reading_count();
}

v1::Calibration CalibrateOnServer(const client::Client& client, const formats::RobotFile& robot) {
  v1::CreateCalibrationJobRequest request;
  request.set_job_id(kJob);
  request.set_robot("robots/" + robot.robot_id);
  request.add_sessions(std::string("sessions/") + kSession);
  request.mutable_options()->set_split("even-odd");
  const std::string job = Demand(client.CreateCalibrationJob(request)).name();
  v1::GetCalibrationRequest get;
  get.set_name(Demand(client::WaitForJob(client, job)).calibration());
  return Demand(client.GetCalibration(get));
}

void SeriesC(benchmark::State& state) {
  for (auto _ : state) {
    const Folder folder;
    const auto server = StartServer(folder);
    const client::Client client = Demand(client::Client::Connect(server->address()));
    const formats::RobotFile robot = AddRobot(client);
    state.counters["readings"] = Import(client, robot);
    const v1::Calibration calibration = CalibrateOnServer(client, robot);
    state.counters["control_rms_mm"] =
        calibration.report().sets().control().after().position_mm().rms();
  }
}
BENCHMARK(SeriesC)->Iterations(1)->Repetitions(5)->Unit(benchmark::kSecond)->UseRealTime();

}  // namespace
}  // namespace truepose::bench

BENCHMARK_MAIN();
