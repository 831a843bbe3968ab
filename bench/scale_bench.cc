// A plant of 10,000 robots with 10 million readings: how soon a server is ready, how long a page
// and a robot take, and how much memory it keeps, idle and while a million readings stream in. One
// trueposed, made and filled by this program below TMPDIR (about 2 GB).
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <thread>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "bench/ingest_load.h"
#include "client/client.h"
#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/robots.h"
#include "server/store/sessions.h"
#include "server/store/store.h"
#include "tests/integration/server_process.h"

namespace truepose::bench {
namespace {

constexpr int kRobots = 10'000;
constexpr int kSessions = 2'000, kReadings = 5'000;  // of each
constexpr Load kStream{.clients = 8, .messages = 1'250, .batch = 100, .window = 8};
constexpr int kCalls = 3'000;

template <typename T>
T Demand(absl::StatusOr<T> value) {
  if (value.ok()) return *std::move(value);
  std::fprintf(stderr, "%s\n", value.status().ToString().c_str());
  std::exit(1);
}

std::string RobotOf(int number) { return absl::StrFormat("r%05d", number); }

v1::Nominal SixJoints(int serial) {
  v1::Nominal nominal;
  nominal.set_serial(absl::StrCat(serial));
  nominal.set_manufacturer("Example");
  nominal.set_model("Six");
  for (int joint = 0; joint < 6; ++joint) {
    nominal.add_joints()->set_name(absl::StrCat("q", joint + 1));
    nominal.mutable_joints(joint)->set_type(v1::REVOLUTE);
    v1::DhRow* row = nominal.mutable_geometry()->mutable_standard_dh()->add_rows();
    row->set_d_m(0.2);
    row->set_a_m(0.3);
    row->set_alpha_rad(joint % 2 == 0 ? 1.5 : 0);
  }
  return nominal;
}

store::ReadingBatch ManyReadings() {
  google::protobuf::RepeatedPtrField<v1::Reading> readings;
  for (int row = 0; row < kReadings; ++row) {
    v1::Reading& reading = *readings.Add();
    reading.set_row(row);
    for (int joint = 0; joint < 6; ++joint) reading.add_joints_measured(0.1 * joint + 1e-4 * row);
    reading.mutable_position_m()->set_x(1.25);
    reading.mutable_position_m()->set_y(-0.5);
    reading.mutable_position_m()->set_z(0.75);
  }
  return store::ReadingBatch(readings);
}

void AddRobots(store::Store& store) {
  constexpr int kOfOneCommit = 500;
  for (int first = 0; first < kRobots; first += kOfOneCommit) {
    Demand(store.Write([&](store::Transaction& transaction) -> absl::StatusOr<bool> {
      for (int i = first; i < first + kOfOneCommit; ++i) {
        const auto made =
            store::CreateRobot(transaction, RobotOf(i), SixJoints(i), absl::StrCat("digest ", i));
        if (!made.ok()) return made.status();
      }
      return true;
    }));
  }
}

void AddSession(store::Store& store, const std::string& id, const store::ReadingBatch& readings) {
  Demand(store.Write([&](store::Transaction& transaction) -> absl::StatusOr<bool> {
    v1::Session session;
    session.set_robot(absl::StrCat("robots/", RobotOf(0)));
    const auto made = store::CreateSession(transaction, id, session);
    if (!made.ok()) return made.status();
    if (readings.empty()) return true;
    const auto count = store::AppendReadings(transaction, made->name(), readings);
    return count.ok() ? absl::StatusOr<bool>(true) : count.status();
  }));
}

void Fill(const std::string& path) {
  const auto store = Demand(store::Store::Open({.path = path}));
  AddRobots(*store);
  const store::ReadingBatch readings = ManyReadings();
  for (int i = 0; i < kSessions; ++i)
    AddSession(*store, absl::StrFormat("00000000-0000-4000-9000-%012d", i), readings);
  for (int i = 0; i < kStream.clients; ++i)
    AddSession(*store, SessionOf(i).substr(std::string("sessions/").size()), {});
}

// The share of values that is at most this, of sorted values.
double Percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
}

template <typename Call>
double Milliseconds(Call call) {
  const absl::Time begin = absl::Now();
  Demand(call());
  return absl::ToDoubleMilliseconds(absl::Now() - begin);
}

// Of pages of 100 from all over the list.
double MedianPage(const client::Client& client) {
  std::vector<double> times;
  v1::ListRobotsRequest request;
  request.set_page_size(100);
  for (int page = 0; page < kRobots / 100; ++page) {
    times.push_back(Milliseconds([&] {
      auto response = client.ListRobots(request);
      if (response.ok()) request.set_page_token(response->next_page_token());
      return response;
    }));
  }
  return Percentile(times, 0.5);
}

double P99OfGetRobot(const client::Client& client, const std::atomic<bool>& go_on) {
  std::vector<double> times;
  for (int call = 0; call < kCalls && go_on; ++call) {
    v1::GetRobotRequest request;
    request.set_name(absl::StrCat("robots/", RobotOf(call * 7 % kRobots)));
    times.push_back(Milliseconds([&] { return client.GetRobot(request); }));
  }
  return Percentile(times, 0.99);
}

void Tell(const char* what, double found, const char* unit, double limit) {
  std::printf("%-58s %9.2f %-3s limit %7.2f  %s\n", what, found, unit, limit,
              found <= limit ? "kept" : "MISSED");
}

double MegaBytes(int64_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

// Streams a million readings. @returns the largest memory meanwhile, and p99 of GetRobot.
std::pair<double, double> StreamIn(const testing::ServerProcess& process,
                                   const client::Client& client) {
  std::atomic<bool> streaming = true;
  double most = 0, p99 = 0;
  std::thread memory([&] {
    for (; streaming; absl::SleepFor(absl::Milliseconds(20)))
      most = std::max(most, MegaBytes(process.ResidentBytes()));
  });
  std::thread reader([&] { p99 = P99OfGetRobot(client, streaming); });
  Send(process.address(), kStream);
  streaming = false;
  memory.join();
  reader.join();
  return {most, p99};
}

void Measure() {
  const testing::TempDir folder;
  const absl::Time begin = absl::Now();
  Fill(folder.File("t.db"));
  std::printf("filled within %.0f s, %.0f MB\n", absl::ToDoubleSeconds(absl::Now() - begin),
              MegaBytes(static_cast<int64_t>(std::filesystem::file_size(folder.File("t.db")))));
  testing::ServerProcess process(folder, {"--database", folder.File("t.db")});
  if (!process.WaitUntilReady()) std::exit(1);
  Tell("ready after", absl::ToDoubleSeconds(process.ready_after()), "s", 1);
  Tell("memory before the first call", MegaBytes(process.ResidentBytes()), "MB", 60);
  const client::Client client = Demand(client::Client::Connect(process.address()));
  Tell("a page of 100 robots, median", MedianPage(client), "ms", 20);
  const double idle = P99OfGetRobot(client, true);
  Tell("memory idle, after 100 pages and 3,000 GetRobot", MegaBytes(process.ResidentBytes()), "MB",
       60);
  const auto [most, loaded] = StreamIn(process, client);
  std::printf(
      "GetRobot, p99 at the client: idle %.2f ms, while a million readings stream in %.2f\n", idle,
      loaded);
  Tell("  its ratio", loaded / idle, "", 5);
  std::printf("memory while a million readings stream in: at most %.0f MB\n", most);
  Tell("memory after that", MegaBytes(process.ResidentBytes()), "MB", 200);
}

}  // namespace
}  // namespace truepose::bench

int main() {
  truepose::bench::Measure();
  return 0;
}
