// How many readings a second are durable: our server beside raw SQLite (no network, no checks) and
// beside a gRPC server that keeps nothing, in one run. Server and clients share the machine's
// cores.
#include <benchmark/benchmark.h>

#include <string>

#include "bench/bench_server.h"
#include "bench/ingest_load.h"
#include "bench/peers/grpc_echo.h"
#include "bench/peers/raw_sqlite.h"
#include "bench/rates.h"
#include "client/client.h"

namespace truepose::bench {
namespace {

constexpr Load kSingles{.clients = 64, .messages = 200};
// A client that goes on while its last readings are under way, as an agent does.
constexpr Load kStreamedSingles{.clients = 64, .messages = 200, .window = 8};
constexpr Load kBatches{.clients = 1, .messages = 1'000, .batch = 100, .window = 8};
constexpr int kRawCommits = 1'000;

v1::Nominal SixJoints() {
  v1::Nominal nominal;
  for (int joint = 0; joint < 6; ++joint) {
    nominal.add_joints()->set_name("q" + std::to_string(joint + 1));
    nominal.mutable_joints(joint)->set_type(v1::REVOLUTE);
    v1::DhRow* row = nominal.mutable_geometry()->mutable_standard_dh()->add_rows();
    row->set_d_m(0.2);
    row->set_a_m(0.3);
    row->set_alpha_rad(joint % 2 == 0 ? 1.5 : 0);
  }
  return nominal;
}

void AddSessions(const std::string& address, int count) {
  const client::Client client = Demand(client::Client::Connect(address));
  v1::CreateRobotRequest robot;
  robot.set_robot_id("arm");
  *robot.mutable_nominal() = SixJoints();
  Demand(client.CreateRobot(robot));
  for (int i = 0; i < count; ++i) {
    v1::CreateSessionRequest session;
    session.set_session_id(SessionOf(i).substr(std::string("sessions/").size()));
    session.mutable_session()->set_robot("robots/arm");
    Demand(client.CreateSession(session));
  }
}

void Count(benchmark::State& state, const Load& load) {
  state.SetItemsProcessed(state.iterations() * load.clients * load.messages * load.batch);
}

void Ours(benchmark::State& state, const Load& load) {
  for (auto _ : state) {
    state.PauseTiming();
    const Folder folder;
    const auto server = StartServer(folder);
    AddSessions(server->address(), load.clients);
    state.ResumeTiming();
    Send(server->address(), load);
    state.PauseTiming();
    server->Stop();
    state.ResumeTiming();
  }
  Count(state, load);
}

void Echo(benchmark::State& state, const Load& load) {
  const GrpcEcho echo;
  for (auto _ : state) Send(echo.address(), load);
  Count(state, load);
}

void Raw(benchmark::State& state, int rows, int batch) {
  for (auto _ : state) {
    const Folder folder;
    FillRawSqlite(folder.File("raw.db"), rows, batch);
  }
  state.SetItemsProcessed(state.iterations() * rows);
}

void RawSqliteACommitEach(benchmark::State& state) { Raw(state, kRawCommits, 1); }
void EchoSingles(benchmark::State& state) { Echo(state, kSingles); }
void OurSingles(benchmark::State& state) { Ours(state, kSingles); }
void OurStreamedSingles(benchmark::State& state) { Ours(state, kStreamedSingles); }
void RawSqliteBatches(benchmark::State& state) {
  Raw(state, kBatches.messages * kBatches.batch, kBatches.batch);
}
void EchoBatches(benchmark::State& state) { Echo(state, kBatches); }
void OurBatches(benchmark::State& state) { Ours(state, kBatches); }

void Repeat(benchmark::internal::Benchmark* benchmark) {
  benchmark->Iterations(1)->Repetitions(5)->Unit(benchmark::kMillisecond)->UseRealTime();
}
BENCHMARK(RawSqliteACommitEach)->Apply(Repeat);
BENCHMARK(EchoSingles)->Apply(Repeat);
BENCHMARK(OurSingles)->Apply(Repeat);
BENCHMARK(OurStreamedSingles)->Apply(Repeat);
BENCHMARK(RawSqliteBatches)->Apply(Repeat);
BENCHMARK(EchoBatches)->Apply(Repeat);
BENCHMARK(OurBatches)->Apply(Repeat);

}  // namespace
}  // namespace truepose::bench

int main(int argc, char** argv) {
  return truepose::bench::RunWithRates(argc, argv,
                                       {{"OurSingles", "RawSqliteACommitEach", 2.0},
                                        {"OurStreamedSingles", "RawSqliteACommitEach", 2.0},
                                        {"OurBatches", "RawSqliteBatches", 0.55},
                                        {"OurSingles", "EchoSingles", 0},
                                        {"OurBatches", "EchoBatches", 0}});
}
