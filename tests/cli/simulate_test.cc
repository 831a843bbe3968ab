#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/run.h"
#include "tests/cli/temp_folder.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Would catch a seed that is not used, or a second source of chance.
TEST(Simulate, EqualSeedsGiveEqualFiles) {
  const std::vector<std::string> line = {"simulate", Example("ur10.yaml"), "--poses", "5",
                                         "--seed"};
  const auto with = [&](const char* seed) {
    std::vector<std::string> complete = line;
    complete.push_back(seed);
    return RunCli(complete).out;
  };
  EXPECT_EQ(with("7"), with("7"));
  EXPECT_NE(with("7"), with("8"));
  EXPECT_THAT(with("7"), StartsWith("q1_rad,"));
}

// Would catch errors, noise or resolution that do not reach the simulation.
TEST(Simulate, EveryFigureMatters) {
  const std::vector<std::string> line = {"simulate", "--measuring-robot", "--poses", "4"};
  const std::string plain = RunCli(line).out;
  for (const char* option : {"--length-error-mm", "--angle-error-deg", "--noise-mm", "--noise-deg",
                             "--joint-noise-deg", "--encoder-resolution-deg"}) {
    std::vector<std::string> more = line;
    more.insert(more.end(), {option, "0.25"});
    const Ran ran = RunCli(more);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.out, plain) << option;
  }
}

// Would catch a truth that is not the one of the session: applied as a calibration it explains
// every pose.
TEST(Simulate, TruthExplainsTheSession) {
  const TempFolder folder;
  const std::string session = folder.Path("s.csv"), truth = folder.Path("t.json");
  ASSERT_EQ(RunCli({"simulate", Example("franka_panda.yaml"), "--poses", "30", "--noise-mm", "0",
                    "--noise-deg", "0", "--output", session, "--truth", truth})
                .code,
            0);
  const Ran ran = RunCli({"evaluate", "--local", "--robot", Example("franka_panda.yaml"),
                          "--calibration", truth, "--session", session, "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto evaluation = OneObject(ran.out);
  EXPECT_GT(std::stod(At(evaluation, "set.before.position_mm.rms")), 0.1);
  // 1 um: what the solver leaves of base and tool.
  EXPECT_LT(std::stod(At(evaluation, "set.after.position_mm.rms")), 1e-3);
}

// Would catch figures without sense that are taken, or told in words nobody typed.
TEST(Simulate, BadFiguresAreFaultsOfTheirOptions) {
  const Ran ran = RunCli({"simulate", "--measuring-robot", "--poses", "0", "--noise-mm", "-1",
                          "--noise-deg", "nan", "--json"});
  EXPECT_EQ(ran.code, 3);
  const auto error = OneObject(ran.out);
  EXPECT_EQ(At(error, "error.faults"), "[3]");
  EXPECT_EQ(At(error, "error.faults.0.field"), "--poses");
  EXPECT_THAT(At(error, "error.faults.1.field"), StartsWith("--noise-mm"));
  EXPECT_THAT(At(error, "error.faults.2.field"), StartsWith("--noise-deg"));
}

// Would catch one file written when the other can't be.
TEST(Simulate, WritesBothFilesOrNone) {
  const TempFolder folder;
  const Ran ran = RunCli({"simulate", "--measuring-robot", "--poses", "3", "--output",
                          folder.Path("s.csv"), "--truth", folder.Path("none/t.json")});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("--truth: found"));
  EXPECT_EQ(folder.FileCount(), 0);
}

TEST(Simulate, JsonIsTheSession) {
  const Ran ran = RunCli({"simulate", "--measuring-robot", "--poses", "3", "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(At(OneObject(ran.out), "readings"), "[3]");
}

}  // namespace
}  // namespace truepose::cli
