// From an activation to 100 agents that run the set: 100 keepers over connections of their own, in
// one process with the server, with tables of several sizes. Beside it the bytes alone: the same
// download over the same connections, with nothing that watches, checks or keeps.
#include <array>
#include <cstdio>
#include <thread>
#include <vector>

#include "bench/bench_server.h"
#include "client/agent/released/released_keeper.h"
#include "client/append_readings.h"
#include "client/download.h"
#include "client/wait_for_job.h"
#include "convert/run.h"
#include "tests/agent/released/released_testing.h"

namespace truepose::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kAgents = 100;
constexpr double kLimitSeconds = 1;
constexpr char kRobot[] = "robots/arm";
constexpr char kUuid[] = "6f2c1d8e-0b6a-4c59-9d57-00000000000";

double SecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::string CalibrationName(int number) {
  return std::string(kRobot) + "/calibrations/" + std::to_string(number);
}

std::unique_ptr<server::Server> StartTableServer(const Folder& folder,
                                                 const std::array<int, 4>& nodes) {
  server::ServerOptions options;
  options.dev_open = true;
  options.listen = "127.0.0.1:0";
  options.database = folder.File("truepose.db");
  return Demand(server::Server::Start(
      options,
      jobs::Runners(server::CalibrationRunner(), agent::testing::TestTableBuilder(nodes), {})));
}

// robots/arm with a sealed session.
void Import(const client::Client& client) {
  v1::CreateRobotRequest robot;
  robot.set_robot_id("arm");
  *robot.mutable_nominal() = convert::MeasuringRobot();
  Demand(client.CreateRobot(robot));
  convert::SimulationOptions options;
  options.poses = 100;
  options.seed = 1;
  const auto simulation = Demand(convert::RunSimulation(convert::MeasuringRobot(), options));
  const auto& input = simulation.session.readings();
  const std::vector<v1::Reading> readings(input.begin(), input.end());
  v1::CreateSessionRequest create;
  create.set_session_id(kUuid + std::string("1"));
  create.mutable_session()->set_robot(kRobot);
  v1::SealSessionRequest seal;
  seal.set_name(Demand(client.CreateSession(create)).name());
  seal.set_reading_count(Demand(client::AppendReadings(client, seal.name(), readings)));
  Demand(client.SealSession(seal));
}

// An approved calibration with a READY table.
v1::CompensationTable MakeTable(const client::Client& client, int number, const char* split) {
  v1::CreateCalibrationJobRequest job;
  job.set_job_id(kUuid + std::to_string(number + 1));
  job.set_robot(kRobot);
  job.add_sessions("sessions/" + (kUuid + std::string("1")));
  job.mutable_options()->set_split(split);
  Demand(client::WaitForJob(client, Demand(client.CreateCalibrationJob(job)).name()));
  v1::ApproveCalibrationRequest approve;
  approve.set_name(CalibrationName(number));
  Demand(client.ApproveCalibration(approve));
  v1::CreateCompensationTableRequest create;
  create.set_parent(kRobot);
  create.set_compensation_table_id(kUuid + std::to_string(number + 5));
  create.mutable_compensation_table()->set_calibration(approve.name());
  create.mutable_compensation_table()->mutable_spec()->set_seed(1);
  Demand(client::WaitForJob(client, Demand(client.CreateCompensationTable(create)).job()));
  v1::GetCompensationTableRequest get;
  get.set_name(kRobot + std::string("/compensationTables/") + create.compensation_table_id());
  return Demand(client.GetCompensationTable(get));
}

void Activate(const client::Client& client, int number) {
  v1::ActivateCalibrationRequest activate;
  activate.set_name(CalibrationName(number));
  Demand(client.ActivateCalibration(activate));
}

struct Plant {
  explicit Plant(const std::string& address) {
    for (int i = 0; i < kAgents; ++i) {
      clients.push_back(Demand(client::Client::Connect(address)));
      Demand(clients.back().GetServerStatus({}));
    }
    for (int i = 0; i < kAgents; ++i)
      keepers.push_back(std::make_unique<agent::ReleasedKeeper>(
          clients[i], disk,
          agent::ReleasedKeeperOptions{.robot = kRobot,
                                       .folder = folder.File(std::to_string(i).c_str())},
          [](const std::string&) {}));
  }
  ~Plant() {
    for (const auto& keeper : keepers) keeper->RequestStop();
  }
  bool AllRun(int number) const {
    for (const auto& keeper : keepers) {
      const auto state = keeper->state();
      if (state->current == nullptr ||
          state->current->entry().calibration != CalibrationName(number))
        return false;
    }
    return true;
  }
  // @returns the time.
  double WaitUntilAllRun(int number, Clock::time_point begin) const {
    while (!AllRun(number)) {
      if (SecondsSince(begin) > 120) std::exit(1);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return SecondsSince(begin);
  }
  // All of them at once.
  double Download(const v1::CompensationTable& table) const {
    const auto begin = Clock::now();
    std::vector<std::thread> threads;
    for (const client::Client& client : clients)
      threads.emplace_back([&] { Demand(client::Download(client, table.name(), {})); });
    for (std::thread& thread : threads) thread.join();
    return SecondsSince(begin);
  }

  const Folder folder;
  agent::Disk disk;
  std::vector<client::Client> clients;
  std::vector<std::unique_ptr<agent::ReleasedKeeper>> keepers;
};

void Measure(const std::array<int, 4>& nodes) {
  const Folder folder;
  const auto server = StartTableServer(folder, nodes);
  const client::Client client = Demand(client::Client::Connect(server->address()));
  Import(client);
  MakeTable(client, 1, "even-odd");
  const v1::CompensationTable second = MakeTable(client, 2, "first:60");
  Activate(client, 1);
  const Plant plant(server->address());
  plant.WaitUntilAllRun(1, Clock::now());
  const auto begin = Clock::now();
  Activate(client, 2);
  const double seconds = plant.WaitUntilAllRun(2, begin);
  v1::RollBackCalibrationRequest back;
  back.set_robot(kRobot);
  const auto back_begin = Clock::now();
  Demand(client.RollBackCalibration(back));
  const double back_seconds = plant.WaitUntilAllRun(1, back_begin);
  const double bytes_alone = plant.Download(second);
  std::printf(
      "table of %7.3f MB to %d agents: %.3f s from activation (limit %.1f, %s), roll back %.3f s; "
      "the bytes alone %.3f s, ratio %.1f\n",
      static_cast<double>(second.size_bytes()) / 1e6, kAgents, seconds, kLimitSeconds,
      seconds <= kLimitSeconds ? "kept" : "MISSED", back_seconds, bytes_alone,
      seconds / bytes_alone);
}

}  // namespace
}  // namespace truepose::bench

int main() {
  truepose::bench::Measure({2, 3, 2, 3});
  truepose::bench::Measure({8, 8, 8, 8});
  truepose::bench::Measure({12, 12, 12, 12});
  return 0;
}
