// truepose-agent as a program: its options, exit codes, log, systemd, and what it is made of.
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "gmock/gmock.h"
#include "tests/agent/testing/agent_process.h"
#include "tests/agent/testing/line_client.h"

namespace truepose {
namespace {

using nlohmann::json;
using testing::AgentProcess;
using ::testing::HasSubstr;
using testing::LineClient;
using testing::TempDir;

struct Ran {
  int code;
  std::string out;
};

Ran RunProgram(const std::string& arguments) {
  FILE* const pipe = popen(absl::StrCat(arguments, " 2>&1").c_str(), "r");
  std::string out;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) out.push_back(static_cast<char>(c));
  return {WEXITSTATUS(pclose(pipe)), out};
}

class AgentProgramTest : public ::testing::Test {
 protected:
  // No server is there: the agent has to do without.
  std::string Config(const std::string& more = "") const {
    return absl::StrCat("agent = \"cell\"\nserver = \"unix:", folder_.File("nobody"),
                        "\"\nspool = \"", folder_.File("spool"), "\"\nlisten = \"127.0.0.1:0\"\n",
                        more, "[[robot]]\nname = \"arm\"\njoints = 6\n");
  }
  TempDir folder_;
};

// Would catch an example that is printed and does not work, and faults that are told one by one.
TEST_F(AgentProgramTest, HelpAndCheckConfig) {
  EXPECT_THAT(RunProgram(absl::StrCat(TRUEPOSE_AGENT, " --help")).out, HasSubstr("Examples:"));
  EXPECT_EQ(RunProgram(absl::StrCat(TRUEPOSE_AGENT, " --wrong")).code, 2);
  const std::string file = folder_.File("a.toml");
  std::ofstream(file) << Config();
  const std::string check = absl::StrCat(TRUEPOSE_AGENT, " --check-config --config ", file);
  EXPECT_EQ(RunProgram(check).code, 0);
  std::ofstream(file) << Config("colour = 1\nkeep_days = \"week\"\n");
  const Ran faulty = RunProgram(check);
  EXPECT_EQ(faulty.code, 3);
  EXPECT_THAT(faulty.out, HasSubstr("a.toml:5: colour"));
  EXPECT_THAT(faulty.out, HasSubstr("a.toml:6: keep_days"));
}

// Would catch an agent that needs its server to take readings, and one that loses them when it is
// stopped, or a log that no program can read.
TEST_F(AgentProgramTest, TakesReadingsWithoutAServer) {
  {
    AgentProcess agent(folder_, Config());
    ASSERT_TRUE(agent.WaitUntilReady()) << agent.Output();
    LineClient client(agent.address());
    ASSERT_TRUE((*client.Ask({{"op", "begin"}, {"robot", "arm"}})).at("ok"));
    const json reading = {
        {"op", "reading"}, {"joints", {1, 2, 3, 4, 5, 6}}, {"position_mm", {1, 2, 3}}};
    for (int number = 1; number <= 20; ++number)
      ASSERT_EQ((*client.Ask(reading)).at("number"), number);
    const json status = *client.Ask({{"op", "status"}});
    EXPECT_EQ(status.at("waiting_readings"), 20);
    EXPECT_FALSE(status.at("connected"));
    agent.Signal(SIGTERM);
    EXPECT_EQ(agent.Wait(), 0);
    for (const auto line : absl::StrSplit(agent.Output(), '\n', absl::SkipEmpty()))
      EXPECT_TRUE(json::accept(std::string(line))) << std::string(line);
  }
  AgentProcess agent(folder_, Config());
  ASSERT_TRUE(agent.WaitUntilReady());
  LineClient client(agent.address());
  EXPECT_EQ((*client.Ask({{"op", "status"}})).at("waiting_readings"), 20);
}

// Would catch two agents that share a spool, or one that does not say who has it.
TEST_F(AgentProgramTest, ASecondAgentWithTheSameSpoolIsRefused) {
  AgentProcess first(folder_, Config());
  ASSERT_TRUE(first.WaitUntilReady());
  const std::string file = folder_.File("b.toml");
  std::ofstream(file) << Config();
  const Ran second = RunProgram(absl::StrCat(TRUEPOSE_AGENT, " --config ", file));
  EXPECT_EQ(second.code, 5);
  EXPECT_THAT(second.out, HasSubstr("in use by process"));
}

// Would catch a unit that systemd takes for one that never starts, or kills as hanging.
TEST_F(AgentProgramTest, TellsSystemd) {
  const std::string path = folder_.File("notify");
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof(address.sun_path) - 1);
  const int socket_ = socket(AF_UNIX, SOCK_DGRAM, 0);
  ASSERT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
  setenv("NOTIFY_SOCKET", path.c_str(), 1);
  setenv("WATCHDOG_USEC", "200000", 1);
  AgentProcess agent(folder_, Config());
  unsetenv("NOTIFY_SOCKET");
  unsetenv("WATCHDOG_USEC");
  const auto next = [&] {
    char text[64] = "";
    const ssize_t n = recv(socket_, text, sizeof(text), 0);
    return std::string(text, n > 0 ? n : 0);
  };
  EXPECT_EQ(next(), "READY=1");
  EXPECT_EQ(next(), "WATCHDOG=1");
  agent.Signal(SIGTERM);
  std::string last = next();
  while (last == "WATCHDOG=1") last = next();
  EXPECT_EQ(last, "STOPPING=1");
  close(socket_);
}

// Would catch what computes creeping into the thin client.
TEST_F(AgentProgramTest, LinksNoMathematicsAndNoDatabase) {
  const std::string libraries = RunProgram(absl::StrCat("ldd ", TRUEPOSE_AGENT)).out;
  EXPECT_THAT(libraries, HasSubstr("libgrpc"));
  for (const char* word :
       {"libceres", "libsqlite", "libglog", "libcholmod", "liblapack", "liburdf"})
    EXPECT_THAT(libraries, ::testing::Not(HasSubstr(word)));
  // Of the core, what reads faults and statuses only; of convert, the rules of readings.
  const std::string symbols =
      RunProgram(absl::StrCat("nm -C --defined-only ", TRUEPOSE_AGENT,
                              " | grep 'truepose::Model\\|truepose::Robot::\\|truepose::convert::'"
                              " | grep -vc 'convert::\\((anonymous "
                              "namespace)::\\)\\?\\(Check\\|Is\\|Are\\|UnitOf\\)'"))
          .out;
  EXPECT_EQ(symbols, "0\n");
}

}  // namespace
}  // namespace truepose
