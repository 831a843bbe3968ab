#include "client/cli/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/run.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Every leaf of the command tree.
const std::vector<std::vector<std::string>>& Commands() {
  static const auto* commands =
      new std::vector<std::vector<std::string>>{{"robot", "add"},
                                                {"robot", "list"},
                                                {"robot", "show"},
                                                {"session", "import"},
                                                {"session", "list"},
                                                {"session", "show"},
                                                {"calibrate"},
                                                {"evaluate"},
                                                {"compensate"},
                                                {"job", "watch"},
                                                {"job", "list"},
                                                {"job", "cancel"},
                                                {"simulate"},
                                                {"model"},
                                                {"calibration", "list"},
                                                {"calibration", "show"},
                                                {"calibration", "convert"},
                                                {"calibration", "approve"},
                                                {"calibration", "reject"},
                                                {"calibration", "activate"},
                                                {"calibration", "rollback"},
                                                {"calibration", "history"},
                                                {"calibration", "compare"},
                                                {"robot", "update"},
                                                {"robot", "delete"},
                                                {"session", "export"},
                                                {"session", "undelete"},
                                                {"instrument", "create"},
                                                {"tool", "show"},
                                                {"fixture", "update"},
                                                {"target", "delete"},
                                                {"placement", "undelete"},
                                                {"pose-set", "list"},
                                                {"watch"},
                                                {"version"}};
  return *commands;
}

// Would catch a command without help, without an example or without --json.
TEST(Help, OfEveryCommandHasAnExample) {
  for (std::vector<std::string> command : Commands()) {
    command.push_back("--help");
    const Ran ran = RunCli(command);
    EXPECT_EQ(ran.code, 0) << command.front();
    EXPECT_THAT(ran.out, HasSubstr("Example")) << command.front();
    EXPECT_THAT(ran.out, HasSubstr("--json")) << command.front();
    EXPECT_EQ(ran.err, "");
  }
}

// Would catch a group of commands that ends with the text of the whole program.
TEST(Help, OfAGroupIsAboutTheGroup) {
  for (const char* group :
       {"reproduce", "robot", "session", "job", "calibration", "instrument", "pose-set"}) {
    const Ran ran = RunCli({group, "--help"});
    EXPECT_EQ(ran.code, 0);
    EXPECT_THAT(ran.out, ::testing::Not(HasSubstr("Exit codes"))) << group;
    EXPECT_THAT(ran.out, HasSubstr("Example")) << group;
  }
}

// Would catch an exit code that is given but not documented where people look.
TEST(Help, ListsCommandsAndExitCodes) {
  const Ran ran = RunCli({"--help"});
  EXPECT_EQ(ran.code, 0);
  for (const char* name :
       {"serve", "robot", "session", "calibrate", "evaluate", "compensate", "job", "calibration",
        "simulate", "model", "version", "0  done", "1  the run", "2  the command line",
        "3  the input", "4  the server", "5  the database", "6  not found"}) {
    EXPECT_THAT(ran.out, HasSubstr(name));
  }
}

// Would catch a misunderstood command line that runs something, or that ends like a fault of the
// input.
TEST(Usage, IsExitCodeTwoAndSaysWhatToTry) {
  const std::vector<std::vector<std::string>> lines = {{},
                                                       {"robot"},
                                                       {"nonsense"},
                                                       {"robot", "add"},
                                                       {"robot", "list", "--nonsense"},
                                                       {"calibrate", "--robot", "a"},
                                                       {"robot", "list", "extra"}};
  for (const auto& line : lines) {
    const Ran ran = RunCli(line);
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(ran.err, StartsWith("truepose: "));
    EXPECT_THAT(ran.err, HasSubstr("--help`"));
  }
}

// Would catch options that contradict each other and are silently ignored.
TEST(Usage, RefusesOptionsOfTheOtherWay) {
  const std::vector<std::vector<std::string>> lines = {
      {"calibrate", "--robot", "a", "--session", "b", "--euler", "xyz-intrinsic"},
      {"calibrate", "--local", "--no-wait", "--robot", "a", "--session", "b"},
      {"calibrate", "--no-wait", "--output", "f", "--robot", "a", "--session", "b"},
      {"evaluate", "--local", "--calibration", "a", "--session", "b"},
      {"evaluate", "--robot", "r", "--calibration", "a#1", "--session", "b"},
      {"compensate", "t.csv", "--local", "--calibration", "a"},
      {"compensate", "t.csv", "--robot", "r", "--calibration", "a#1"},
      {"simulate"},
      {"model"},
      {"simulate", "a.yaml", "--measuring-robot"}};
  for (const auto& line : lines) EXPECT_EQ(RunCli(line).code, 2) << line.front();
}

// Would catch a value of the wrong type reported as a wrong command line, or without its option.
TEST(OptionValue, IsAFaultOfItsOption) {
  const Ran ran = RunCli({"simulate", "--measuring-robot", "--poses", "many", "--json"});
  EXPECT_EQ(ran.code, 3);
  const auto error = OneObject(ran.out);
  EXPECT_EQ(At(error, "error.faults.0.field"), "--poses");
  EXPECT_EQ(At(error, "error.faults.0.found"), "'many'");
}

TEST(OptionValue, OfObserveIsOneOfThree) {
  const Ran ran = RunCli({"calibrate", "--robot", "a", "--session", "b", "--observe", "sphere"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_EQ(ran.err, "truepose: --observe: found 'sphere', expected pose, point or point_axis\n");
}

// Would catch a name that can't be one being sent to a server.
TEST(OptionValue, OfCalibrationIsCheckedBeforeAnyServer) {
  for (const std::vector<std::string>& line :
       {std::vector<std::string>{"compensate", "t.csv", "--calibration", "ur10"},
        {"evaluate", "--calibration", "ur10", "--session", "b"},
        {"calibration", "show", "ur10"}}) {
    const Ran ran = RunCli(line);
    EXPECT_EQ(ran.code, 3) << line.front();
    EXPECT_THAT(ran.err, HasSubstr("such as ur10#1"));
  }
}

// Would catch usage errors that break a reader of --json.
TEST(Json, OfAUsageErrorIsOneObject) {
  const Ran ran = RunCli({"robot", "add", "--json"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_EQ(At(OneObject(ran.out), "error.code"), "INVALID_ARGUMENT");
}

// Would catch a hang, a crash or a silent success without a server.
TEST(Unreachable, IsExitCodeFourWithAHint) {
  for (std::vector<std::string> line : {std::vector<std::string>{"robot", "list"},
                                        {"job", "list"},
                                        {"calibration", "list"},
                                        {"session", "list"},
                                        {"job", "watch", "a"},
                                        {"calibration", "show", "a#1"}}) {
    line.insert(line.end(), {"--server", "unix:/nonexistent/truepose.sock"});
    const Ran ran = RunCli(line);
    EXPECT_EQ(ran.code, 4) << line.front() << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("unix:/nonexistent/truepose.sock"));
    EXPECT_THAT(ran.err, HasSubstr("truepose serve"));
  }
}

// The variable for one test, whatever it was before.
class ServerVariable {
 public:
  explicit ServerVariable(const char* value) { setenv("TRUEPOSE_SERVER", value, 1); }
  ~ServerVariable() { unsetenv("TRUEPOSE_SERVER"); }
};

// Would catch a variable that is not read, or that wins over what was typed and so asks another
// plant's server.
TEST(Server, IsWhatWasTypedElseTheVariable) {
  const ServerVariable variable("unix:/nonexistent/by-variable");
  EXPECT_THAT(RunCli({"robot", "list"}).err, HasSubstr("unix:/nonexistent/by-variable"));
  for (std::vector<std::string> line : {std::vector<std::string>{"robot", "list"},
                                        {"robot", "show", "a"},
                                        {"job", "list"},
                                        {"calibration", "show", "a#1"},
                                        {"session", "show", "a"}}) {
    line.insert(line.end(), {"--server", "unix:/nonexistent/typed"});
    const Ran ran = RunCli(line);
    EXPECT_EQ(ran.code, 4) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("unix:/nonexistent/typed"));
  }
}

TEST(Unreachable, AddressThatIsNoneIsAFault) {
  EXPECT_EQ(RunCli({"robot", "list", "--server", "nonsense"}).code, 3);
}

TEST(Version, IsPrintedBothWays) {
  EXPECT_EQ(RunCli({"version"}).out, "truepose " TRUEPOSE_VERSION "\n");
  EXPECT_EQ(At(OneObject(RunCli({"version", "--json"}).out), "version"), TRUEPOSE_VERSION);
}

}  // namespace
}  // namespace truepose::cli
