// The agent beside its limits: one reading from its source to the server's acknowledgement, a spool
// of 100,000 readings, memory and start. trueposed on loopback and truepose-agent as processes, in
// a folder below TMPDIR, whose disk decides what a sync costs.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/agent/delivery/delivery.h"
#include "tests/agent/testing/agent_process.h"
#include "tests/integration/server_process.h"
#include "tests/server/testing/examples.h"

namespace truepose::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kSingles = 1'000;
constexpr int64_t kSpooled = 100'000;

template <typename T>
T Demand(absl::StatusOr<T> value) {
  if (value.ok()) return *std::move(value);
  std::fprintf(stderr, "%s\n", value.status().ToString().c_str());
  std::exit(1);
}

double MillisecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void Tell(const char* what, double found, const char* unit, double limit) {
  std::printf("%-58s %9.2f %-3s limit %7.2f  %s\n", what, found, unit, limit,
              found <= limit ? "kept" : "MISSED");
}

v1::Session Content(int number) {
  v1::Session content;
  content.set_name(absl::StrCat("sessions/00000000-0000-4000-8000-00000000000", number));
  content.set_robot("robots/arm");
  return content;
}

v1::Reading ReadingOf(int64_t number) {
  v1::Reading reading;
  for (int joint = 0; joint < 6; ++joint)
    reading.add_joints_measured(0.1 * joint + 1e-6 * static_cast<double>(number));
  reading.mutable_position_m()->set_x(1.25);
  reading.mutable_position_m()->set_y(-0.5);
  reading.mutable_position_m()->set_z(0.75);
  reading.set_time("2026-03-01T14:05:09.25Z");
  return reading;
}

void Fill(agent::SessionFile& session, int64_t readings) {
  constexpr int64_t kOfOneAppend = 10'000;
  for (int64_t first = 1; first <= readings; first += kOfOneAppend) {
    std::vector<v1::Reading> batch;
    for (int64_t number = first; number < first + kOfOneAppend; ++number)
      batch.push_back(ReadingOf(number));
    Demand(session.Append(first, batch));
  }
}

// What the disk and the loopback cost by themselves: a durable append, and a call that does little.
void TellPeers(agent::Spool& spool, const client::Client& client) {
  const auto session = Demand(spool.Begin(Content(9), ""));
  std::vector<double> appends, calls;
  for (int number = 1; number <= kSingles; ++number) {
    auto begin = Clock::now();
    Demand(session->Append(number, {ReadingOf(number)}));
    appends.push_back(MillisecondsSince(begin));
    begin = Clock::now();
    Demand(client.GetServerStatus({}));
    calls.push_back(MillisecondsSince(begin));
  }
  std::printf("beside it: a durable append %.2f ms, a call over loopback %.2f ms (medians)\n",
              Median(appends), Median(calls));
}

double MedianSingle(agent::Spool& spool, agent::Delivery& delivery) {
  const auto session = Demand(spool.Begin(Content(1), ""));
  std::vector<double> times;
  for (int64_t number = 1; number <= kSingles; ++number) {
    const auto begin = Clock::now();
    Demand(session->Append(number, {ReadingOf(number)}));
    delivery.Notify();
    while (session->delivered < number) std::this_thread::yield();
    times.push_back(MillisecondsSince(begin));
  }
  return Median(times);
}

double DeliverMany(agent::Spool& spool, agent::Delivery& delivery) {
  const auto session = Demand(spool.Begin(Content(2), ""));
  Fill(*session, kSpooled);
  const auto begin = Clock::now();
  delivery.Notify();
  while (session->delivered < kSpooled) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return MillisecondsSince(begin) / 1e3;
}

std::string ReadLine(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

// A process with all that in its spool, its server away and then there.
void TellProcess(const testing::TempDir& folder, const std::string& address) {
  std::filesystem::remove_all(folder.File("spool"));
  agent::Disk disk;
  {
    const auto spool = Demand(agent::Spool::Open({.folder = folder.File("spool")}, disk));
    Fill(*Demand(spool->Begin(Content(3), "")), kSpooled);
  }
  testing::AgentProcess agent(
      folder, absl::StrCat("agent = \"bench\"\nserver = \"", address, "\"\nspool = \"",
                           folder.File("spool"), "\"\nlisten = \"127.0.0.1:0\"\n",
                           "[[robot]]\nname = \"arm\"\njoints = 6\n"));
  if (!agent.WaitUntilReady()) std::exit(1);
  Tell("start with 100,000 readings in the spool", agent.ready_after().count() * 1e3, "ms", 200);
  const auto client = Demand(client::Client::Connect(address));
  v1::GetSessionRequest request;
  request.set_name(Content(3).name());
  double most = 0;
  for (auto session = client.GetSession(request);
       !session.ok() || session->reading_count() < kSpooled; session = client.GetSession(request))
    most = std::max(most, static_cast<double>(agent.ResidentBytes()) / (1 << 20));
  Tell("memory while they are delivered, at most", most, "MB", 30);
  Tell("memory after that", static_cast<double>(agent.ResidentBytes()) / (1 << 20), "MB", 30);
}

void Measure() {
  const testing::TempDir folder;
  testing::ServerProcess server(folder,
                                {"--database", folder.File("t.db"), "--listen", "127.0.0.1:0"});
  if (!server.WaitUntilReady()) std::exit(1);
  const std::string address = ReadLine(folder.File("ready"));
  const client::Client client = Demand(client::Client::Connect(address));
  Demand(client.CreateRobot(testing::RobotRequest("arm")));
  agent::Disk disk;
  const auto spool = Demand(agent::Spool::Open({.folder = folder.File("measured")}, disk));
  {
    agent::Delivery delivery(*spool, client, {}, [](const std::string&) {});
    Tell("one reading to its acknowledgement, median", MedianSingle(*spool, delivery), "ms", 2);
    Tell("100,000 spooled readings delivered", DeliverMany(*spool, delivery), "s", 2);
  }
  TellPeers(*spool, client);
  TellProcess(folder, address);
}

}  // namespace
}  // namespace truepose::bench

int main() {
  truepose::bench::Measure();
  return 0;
}
