// The real binaries, for what only a process has: exit codes, signals, `serve`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>

#include "absl/strings/str_cat.h"
#include "server/calibration_runner.h"
#include "server/server.h"
#include "tests/cli/child.h"
#include "tests/cli/run.h"
#include "tests/cli/temp_folder.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;

constexpr char kUuid[] = "11111111-2222-4333-8444-555555555555";

// Looks every 5 ms, for a minute at most, so that a broken program ends a test and not the patience
// of people.
template <typename Condition>
bool Eventually(const Condition& condition) {
  for (int i = 0; i < 12000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

class ProgramTest : public ::testing::Test {
 protected:
  std::vector<std::string> Line(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), TRUEPOSE_PROGRAM);
    return arguments;
  }
  int Run(const std::string& name, const std::vector<std::string>& arguments) const {
    return Child(folder_.Path(""), name, Line(arguments)).Wait();
  }

  const TempFolder folder_;
};

// Would catch a main that loses the code or mixes the streams.
TEST_F(ProgramTest, ExitCodesAndStreams) {
  EXPECT_EQ(Run("version", {"version"}), 0);
  EXPECT_EQ(folder_.Read("version.out"), "truepose " TRUEPOSE_VERSION "\n");
  EXPECT_EQ(Run("usage", {"nonsense"}), 2);
  EXPECT_EQ(folder_.Read("usage.out"), "");
  EXPECT_EQ(Run("input", {"robot", "add", folder_.Path("none.yaml"), "--json"}), 3);
  EXPECT_EQ(At(OneObject(folder_.Read("input.out")), "error.code"), "INVALID_ARGUMENT");
  EXPECT_EQ(
      Run("server", {"robot", "list", "--server", absl::StrCat("unix:", folder_.Path("none"))}), 4);
}

// Would catch a full disk taken for a success.
TEST_F(ProgramTest, AFullStandardOutputIsAFailure) {
  const std::string command =
      absl::StrCat(TRUEPOSE_PROGRAM, " version > /dev/full 2> ", folder_.Path("err"));
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_EQ(folder_.Read("err"), "truepose: standard output can't be written\n");
}

// The life of `truepose serve`: would catch a server that is not found, not stopped, or started
// twice.
TEST_F(ProgramTest, ServeBecomesTheServer) {
  const std::string address = absl::StrCat("unix:", folder_.Path("socket"));
  const std::vector<std::string> serve = {"serve", "--dev-open",   "--listen",
                                          address, "--ready-file", folder_.Path("ready")};
  const auto with = [&](const std::string& database) {
    std::vector<std::string> line = Line(serve);
    line.insert(line.end(), {"--database", folder_.Path(database)});
    return line;
  };
  Child server(folder_.Path(""), "first", with("a.db"));
  ASSERT_TRUE(Eventually([&] { return std::filesystem::exists(folder_.Path("ready")); }))
      << server.Err();
  EXPECT_EQ(Run("list", {"robot", "list", "--server", address}), 0);
  Child taken(folder_.Path(""), "second", with("b.db"));
  EXPECT_EQ(taken.Wait(), 4) << taken.Err();
  server.Signal(SIGTERM);
  EXPECT_EQ(server.Wait(), 0) << server.Err();
  folder_.Write("bad.db",
                "this is not a database, and long enough that nobody takes it for an empty one");
  Child bad(folder_.Path(""), "third", with("bad.db"));
  EXPECT_EQ(bad.Wait(), 5) << bad.Err();
}

// A server whose jobs wait until they are released, in this process.
class WaitingServer {
 public:
  explicit WaitingServer(const std::string& socket) {
    server::ServerOptions options;
    options.dev_open = true;
    options.listen = absl::StrCat("unix:", socket);
    options.database = ":memory:";
    auto started = server::Server::Start(options, [this](const auto& input, const auto& hooks) {
      running_ = true;
      while (!released_ && !hooks.is_cancelled())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return server::CalibrationRunner()(input, hooks);
    });
    EXPECT_TRUE(started.ok()) << started.status();
    server_ = *std::move(started);
  }
  std::string address() const { return server_->address(); }
  bool running() const { return running_; }
  void Release() { released_ = true; }

 private:
  std::atomic<bool> running_{false}, released_{false};
  std::unique_ptr<server::Server> server_;
};

// Would catch Ctrl-C that ends the job, hangs, or leaves a person without a way back to it.
TEST_F(ProgramTest, CtrlCLeavesTheJobRunning) {
  const std::string session = folder_.Path("s.csv");
  ASSERT_EQ(
      Run("simulate", {"simulate", Example("ur10.yaml"), "--poses", "40", "--output", session}), 0);
  WaitingServer server(folder_.Path("socket"));
  const auto remote = [&](std::vector<std::string> line) {
    line.insert(line.end(), {"--server", server.address()});
    return line;
  };
  ASSERT_EQ(Run("add", remote({"robot", "add", Example("ur10.yaml")})), 0);
  ASSERT_EQ(Run("import",
                remote({"session", "import", session, "--robot", "ur10", "--session-id", kUuid})),
            0);
  Child waiting(folder_.Path(""), "wait",
                Line(remote({"calibrate", "--robot", "ur10", "--session", kUuid})));
  ASSERT_TRUE(Eventually([&] { return server.running(); }));
  waiting.Signal(SIGINT);
  EXPECT_EQ(waiting.Wait(), 1);
  EXPECT_THAT(waiting.Err(), HasSubstr("goes on without us: `truepose job watch "));
  server.Release();
  ASSERT_EQ(Run("list", remote({"job", "list", "--json"})), 0);
  const std::string job = At(OneObject(folder_.Read("list.out")), "jobs.0.name");
  EXPECT_EQ(Run("watch", remote({"job", "watch", job})), 0);
  EXPECT_THAT(folder_.Read("watch.out"), HasSubstr("succeeded"));
}

}  // namespace
}  // namespace truepose::cli
