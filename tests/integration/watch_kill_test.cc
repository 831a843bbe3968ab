// Watches of a trueposed that is killed, and of readers that are slow or never read.
#include <grpcpp/grpcpp.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <random>
#include <thread>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/client.h"
#include "gtest/gtest.h"
#include "tests/integration/effects.h"
#include "tests/integration/recorder.h"
#include "tests/integration/server_process.h"
#include "truepose/v1/watch_services.grpc.pb.h"

namespace truepose {
namespace {

using testing::Habits;
using testing::Heard;
using testing::ServerProcess;
using testing::TempDir;
using testing::WatchPosition;

constexpr int kWriters = 16;
constexpr int kLastWriter = 99;  // its one event is the end
constexpr char kLast[] = "instruments/w-99";

bool IsLongRun() { return std::getenv("TRUEPOSE_LONG") != nullptr; }

// Of those who listen, one hurries, one dawdles, and two come and go.
const Habits kHabits[] = {{},
                          {.pause = absl::Milliseconds(15)},
                          {.hang_up_after = 7},
                          {.pause = absl::Milliseconds(5), .hang_up_after = 20}};

class WatchKillTest : public ::testing::Test {
 protected:
  std::unique_ptr<ServerProcess> Start() const {
    auto process = std::make_unique<ServerProcess>(
        folder_, std::vector<std::string>{"--database", folder_.File("t.db")});
    EXPECT_TRUE(process->WaitUntilReady()) << process->Output();
    return process;
  }

  // kWriters change an instrument each; the server is killed until they are through.
  void WriteAndKill(std::unique_ptr<ServerProcess>& process, int changes) {
    const std::string address = process->address();
    std::atomic<int> writing = kWriters;
    std::vector<std::thread> writers;
    for (int writer = 0; writer < kWriters; ++writer) {
      writers.emplace_back([&, writer] {
        testing::ChangeOneInstrument(address, writer, changes);
        --writing;
      });
    }
    while (writing > 0) {
      absl::SleepFor(absl::Milliseconds(std::uniform_int_distribution<int>(100, 500)(random_)));
      process->Kill();
      process = Start();
      ++kills_;
    }
    for (std::thread& writer : writers) writer.join();
    testing::ChangeOneInstrument(address, kLastWriter, 1);
  }

  TempDir folder_;
  std::mt19937_64 random_{77};
  int kills_ = 0;
};

std::vector<Heard> History(const std::string& address, int64_t after) {
  std::vector<Heard> heard;
  for (const v1::WatchEvent& event : testing::EventsAfter(address, after))
    heard.push_back({event.revision(), event.name()});
  return heard;
}

// Would catch a gap, a repeat or a step back where a watch goes on, for each kind of reader. What
// each heard must be the server's history, event by event. TRUEPOSE_LONG makes 20 runs of 10,000
// events.
TEST_F(WatchKillTest, EachReaderHearsEachEventOnce) {
  const int runs = IsLongRun() ? 20 : 1, events = IsLongRun() ? 10'000 : 1'600;
  for (int run = 0; run < runs && !HasFailure(); ++run) {
    auto process = Start();
    const std::string address = process->address();
    testing::ChangeOneInstrument(address, 50, 1);  // something to begin after
    const WatchPosition begin = testing::PositionNow(address);
    std::vector<std::vector<Heard>> heard(std::size(kHabits));
    std::vector<std::thread> readers;
    for (size_t i = 0; i < heard.size(); ++i) {
      readers.emplace_back(
          [&, i] { heard[i] = testing::Record(address, begin, kLast, kHabits[i]); });
    }
    WriteAndKill(process, events / kWriters);
    for (std::thread& reader : readers) reader.join();
    const std::vector<Heard> history = History(address, begin.revision);
    EXPECT_EQ(history.size(), static_cast<size_t>(events + 1));
    for (const std::vector<Heard>& one : heard) EXPECT_TRUE(one == history) << one.size();
    process->Kill();
    for (const char* suffix : {"", "-wal", "-shm"})
      std::filesystem::remove(folder_.File("t.db") + suffix);
  }
  std::cout << runs << " runs of " << events << " events, " << kills_ << " kills\n";
}

// A watch that nobody reads.
struct Stalled {
  Stalled(const std::string& address, const WatchPosition& begin)
      : stub(v1::WatchService::NewStub(testing::ImpatientChannel(address))) {
    v1::WatchRequest request;
    request.set_epoch(begin.epoch);
    request.set_after_revision(begin.revision);
    reader = stub->Watch(&context, request);
  }
  ~Stalled() {
    context.TryCancel();
    reader->Finish();
  }

  const std::unique_ptr<v1::WatchService::Stub> stub;
  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReader<v1::WatchResponse>> reader;
};

// What a server keeps for its readers anyway, such as SQLite's caches, is there before it is
// measured.
void ReadAtOnce(const std::string& address, const WatchPosition& begin) {
  std::vector<std::thread> readers;
  for (int i = 0; i < 8; ++i)
    readers.emplace_back([&] { testing::EventsAfter(address, begin.revision); });
  for (std::thread& reader : readers) reader.join();
}

// Streams are opened one after another in the server.
bool WaitForWatchers(const std::string& address, int64_t count) {
  const auto client = client::Client::Connect(address);
  const absl::Time late = absl::Now() + absl::Seconds(30);
  for (; client.ok() && absl::Now() < late; absl::SleepFor(absl::Milliseconds(20))) {
    const auto status = client->GetServerStatus({});
    if (status.ok() && status->watchers() >= count) return true;
  }
  return false;
}

// The server gives up a reader who takes nothing after 40 s: who waited for one would take longer.
constexpr absl::Duration kNoWaiting = absl::Seconds(20);

// Would catch a server that queues for those who don't read, or lets the others wait for them.
TEST_F(WatchKillTest, StalledReadersCostLittle) {
  const auto process = Start();
  const std::string address = process->address();
  testing::ChangeOneInstrument(address, 50, 1);
  const WatchPosition begin = testing::PositionNow(address);
  // More than a connection takes ahead of its reader.
  testing::ChangeOneInstrument(address, 51, 600, 4'000);
  ReadAtOnce(address, begin);
  const int64_t before = process->ResidentBytes();
  std::vector<std::unique_ptr<Stalled>> stalled;
  for (int i = 0; i < 200; ++i) stalled.push_back(std::make_unique<Stalled>(address, begin));
  ASSERT_TRUE(WaitForWatchers(address, 200));
  // Whoever reads hears everything, while the others hold on to their connections.
  const absl::Time began = absl::Now();
  std::thread writer([&] {
    testing::ChangeOneInstrument(address, 52, 300);
    testing::ChangeOneInstrument(address, kLastWriter, 1);
  });
  const std::vector<Heard> heard = testing::Record(address, begin, kLast, {});
  writer.join();
  const absl::Duration took = absl::Now() - began;
  EXPECT_EQ(heard.size(), 600u + 300 + 1);
  EXPECT_LT(took, kNoWaiting);
  const int64_t cost = process->ResidentBytes() - before;
  EXPECT_LT(cost, 32 << 20);
  std::cout << "200 stalled watchers: " << cost / 1024 << " KiB; a reader beside them heard "
            << heard.size() << " events within " << took << "\n";
}

}  // namespace
}  // namespace truepose
