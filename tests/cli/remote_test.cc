// The commands against a server in this process, on a unix socket of the test's own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "tests/cli/remote_fixture.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

using RemoteTest = RemoteFixture;

// The promise that a report means the same wherever it was made: would catch any difference between
// the two ways.
TEST_F(RemoteTest, ReportIsByteForByteThatOfLocal) {
  AddRobot();
  Import();
  for (const std::string split : {"even-odd", "random:7:0.6", ""}) {
    std::vector<std::string> remote = {"calibrate", "--robot", "ur10",
                                       "--session", kUuid,     "--json"};
    std::vector<std::string> local = {"calibrate", "--local", "--robot", robot_,
                                      "--session", session_,  "--json"};
    for (auto* line : {&remote, &local}) {
      if (!split.empty()) line->insert(line->end(), {"--split", split});
    }
    const Ran by_server = Remote(remote);
    ASSERT_EQ(by_server.code, 0) << by_server.err;
    EXPECT_EQ(by_server.out, RunCli(local).out) << split;
  }
}

// Would catch faults told differently by a server than here.
TEST_F(RemoteTest, FaultsAreThoseOfLocal) {
  AddRobot();
  Import();
  const Ran local = RunCli(
      {"calibrate", "--local", "--robot", robot_, "--session", session_, "--split", "first:999"});
  const Ran remote =
      Remote({"calibrate", "--robot", "ur10", "--session", kUuid, "--split", "first:999"});
  EXPECT_EQ(local.code, 3);
  EXPECT_EQ(remote.code, 3);
  EXPECT_EQ(local.err, remote.err);
}

// A plant engineer's first round, in text: would catch a missing next step or a name that the next
// command refuses.
TEST_F(RemoteTest, EachStepNamesTheNext) {
  EXPECT_THAT(Remote({"robot", "list"}).out, HasSubstr("Next: truepose robot add"));
  EXPECT_THAT(Remote({"robot", "add", robot_}).out,
              HasSubstr("truepose session import FILE.csv --robot ur10"));
  EXPECT_THAT(Remote({"session", "import", session_, "--robot", "ur10", "--session-id", kUuid}).out,
              HasSubstr(absl::StrCat("truepose calibrate --robot ur10 --session ", kUuid)));
  const Ran calibrated =
      Remote({"calibrate", "--robot", "ur10", "--session", kUuid, "--split", "even-odd"});
  EXPECT_THAT(calibrated.out, StartsWith("Calibration ur10#1\n"));
  EXPECT_THAT(calibrated.out, HasSubstr("--calibration ur10#1"));
  const std::string targets =
      folder_.Write("t.csv", "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n0,-90,90,0,90,0\n");
  EXPECT_THAT(Remote({"compensate", targets, "--calibration", "ur10#1"}).out,
              HasSubstr("corrected mm"));
}

// Would catch lists and shows that lose a resource or print another shape.
TEST_F(RemoteTest, ListsAndShowsWhatIsThere) {
  AddRobot();
  Import();
  Calibrate();
  EXPECT_EQ(At(OneObject(Remote({"robot", "list", "--json"}).out), "robots.0.name"), "robots/ur10");
  EXPECT_EQ(At(OneObject(Remote({"session", "list", "--robot", "ur10", "--json"}).out),
               "sessions.0.reading_count"),
            "40");
  const auto jobs = OneObject(Remote({"job", "list", "--json"}).out);
  EXPECT_EQ(At(jobs, "jobs.0.state"), "SUCCEEDED");
  EXPECT_EQ(At(jobs, "jobs.0.calibration"), "robots/ur10/calibrations/1");
  EXPECT_EQ(At(OneObject(Remote({"calibration", "list", "--json"}).out),
               "calibrations.0.report.parameters.identified"),
            "30");
  EXPECT_THAT(Remote({"robot", "list"}).out, HasSubstr("robots/ur10/nominals/1"));
  EXPECT_THAT(Remote({"robot", "show", "ur10"}).out, HasSubstr("shoulder_pan"));
  EXPECT_THAT(Remote({"session", "list"}).out, HasSubstr("sealed"));
  EXPECT_THAT(Remote({"session", "show", kUuid}).out, HasSubstr("readings 40, sealed"));
  EXPECT_THAT(Remote({"job", "list"}).out, HasSubstr("succeeded"));
  EXPECT_THAT(Remote({"calibration", "list"}).out, HasSubstr("ur10#1"));
  EXPECT_EQ(Remote({"calibration", "list"}).out,
            Remote({"calibration", "list", "--robot", "ur10"}).out);
  EXPECT_THAT(Remote({"calibration", "show", "ur10#1"}).out, HasSubstr("Verdict: "));
  const std::string job = At(jobs, "jobs.0.name");
  EXPECT_THAT(Remote({"job", "watch", job}).out, HasSubstr("succeeded, calibration ur10#1"));
}

// Would catch a list in which a calibration of one joint looks like one of the robot, and a prior
// that was not found being sought among robots.
TEST_F(RemoteTest, PartialCalibrationsAreToldFromWholeOnes) {
  AddRobot();
  Import();
  Calibrate();
  const std::vector<std::string> partial = {"calibrate",   "--robot", "ur10",    "--session", kUuid,
                                            "--calibrate", "dq3",     "--prior", "ur10#1"};
  ASSERT_EQ(Remote(partial).code, 0);
  const std::string list = Remote({"calibration", "list"}).out;
  EXPECT_THAT(list, HasSubstr("ur10#2       dq3 from ur10#1"));
  EXPECT_THAT(list, HasSubstr("ur10#1       all  "));
  std::vector<std::string> missing = partial;
  missing.back() = "ur10#9";
  const Ran ran = Remote(missing);
  EXPECT_EQ(ran.code, 6);
  EXPECT_THAT(ran.err, HasSubstr("truepose calibration list"));
  EXPECT_THAT(ran.err, ::testing::Not(HasSubstr("truepose robot list")));
}

// A stored one by its name, without a file: the same as of its file.
TEST_F(RemoteTest, ConvertsWhatIsStored) {
  AddRobot();
  Import();
  Calibrate();
  const std::string file = folder_.Path("stored.json");
  ASSERT_EQ(Remote({"calibration", "show", "ur10#1", "--output", file}).code, 0);
  const Ran stored =
      Remote({"calibration", "convert", "ur10#1", "--model", "zhuang_roth", "--json"});
  ASSERT_EQ(stored.code, 0) << stored.err;
  EXPECT_EQ(stored.out, RunCli({"calibration", "convert", file, "--robot", robot_, "--model",
                                "zhuang_roth", "--json"})
                            .out);
}

// Would catch a server's calibration that local commands can't use, or that gives other bits there.
TEST_F(RemoteTest, ShownCalibrationWorksLocally) {
  AddRobot();
  Import();
  Calibrate();
  const std::string file = folder_.Path("c.json");
  ASSERT_EQ(Remote({"calibration", "show", "ur10#1", "--output", file}).code, 0);
  const std::string targets =
      folder_.Write("t.csv", "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n5,-80,90,3,80,1\n");
  const Ran remote = Remote({"compensate", targets, "--calibration", "ur10#1", "--json"});
  const Ran local = RunCli(
      {"compensate", targets, "--local", "--robot", robot_, "--calibration", file, "--json"});
  EXPECT_EQ(remote.code, 0) << remote.err;
  EXPECT_EQ(remote.out, local.out);
  const std::string check = folder_.Path("check.csv");
  ASSERT_EQ(RunCli({"simulate", robot_, "--poses", "20", "--seed", "9", "--output", check}).code,
            0);
  ASSERT_EQ(
      Remote({"session", "import", check, "--robot", "ur10", "--session-id", kOtherUuid}).code, 0);
  const Ran evaluated = Remote({"evaluate", "--calibration", "ur10#1", "--session", kOtherUuid});
  EXPECT_EQ(evaluated.code, 0) << evaluated.err;
  EXPECT_EQ(evaluated.out, RunCli({"evaluate", "--local", "--robot", robot_, "--calibration", file,
                                   "--session", check})
                               .out);
}

// Would catch figures of the very rows that calibrated being shown as a check, by either way.
TEST_F(RemoteTest, EvaluatingTheOwnSessionWarns) {
  AddRobot();
  Import();
  Calibrate();
  const std::string warning = "Warning: this session had a part in the calibration";
  EXPECT_THAT(Remote({"evaluate", "--calibration", "ur10#1", "--session", kUuid}).out,
              HasSubstr(warning));
  const std::string file = folder_.Path("c.json");
  ASSERT_EQ(
      RunCli({"calibrate", "--local", "--robot", robot_, "--session", session_, "--output", file})
          .code,
      0);
  EXPECT_THAT(RunCli({"evaluate", "--local", "--robot", robot_, "--calibration", file, "--session",
                      session_})
                  .out,
              HasSubstr(warning));
}

// Would catch a dead end at a name that is not there.
TEST_F(RemoteTest, UnknownNamesAreExitCodeSixAndSayHowToList) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> lines = {
      {{"robot", "show", "ur11"}, "truepose robot list"},
      {{"session", "import", session_, "--robot", "ur11"}, "truepose robot list"},
      {{"session", "show", kUuid}, "truepose session list"},
      {{"job", "watch", kUuid}, "truepose job list"},
      {{"job", "cancel", kUuid}, "truepose job list"},
      {{"calibration", "show", "ur10#9"}, "truepose calibration list"},
      {{"calibrate", "--robot", "ur11", "--session", kUuid}, "truepose robot list"}};
  for (const auto& [line, hint] : lines) {
    const Ran ran = Remote(line);
    EXPECT_EQ(ran.code, 6) << line[0] << " " << line[1] << ": " << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(hint));
  }
}

// Would catch a file given where the server wants a name, answered with a riddle.
TEST_F(RemoteTest, AFileInsteadOfASessionIsExplained) {
  AddRobot();
  const Ran ran = Remote({"calibrate", "--robot", "ur10", "--session", session_});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("truepose session import"));
}

// Would catch a second add that fails, or one of another content that silently wins.
TEST_F(RemoteTest, AddingARobotTwice) {
  AddRobot();
  AddRobot();
  const std::string other =
      folder_.Write("other.yaml", absl::StrReplaceAll(TextOf(robot_), {{"127.3", "128.3"}}));
  const Ran refused = Remote({"robot", "add", other});
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, HasSubstr("--new-revision"));
  const Ran revised = Remote({"robot", "add", other, "--new-revision", "--json"});
  EXPECT_EQ(At(OneObject(revised.out), "nominal_revision.name"), "robots/ur10/nominals/2");
  EXPECT_EQ(Remote({"robot", "add", other, "--name", "ur10-b"}).code, 0);
}

// Would catch bad input that leaves a session behind.
TEST_F(RemoteTest, AFaultyFileLeavesNoSession) {
  AddRobot();
  const std::string bad = folder_.Write("bad.csv",
                                        "q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,x_mm,y_mm,z_mm\n"
                                        "0,0,0,0,0,0,1,2,nan\n");
  EXPECT_EQ(Remote({"session", "import", bad, "--robot", "ur10"}).code, 3);
  const std::string tight = absl::StrReplaceAll(
      TextOf(robot_), {{"-360", "-1"}, {"360", "1"}, {"robot: ur10", "robot: tight"}});
  ASSERT_EQ(Remote({"robot", "add", folder_.Write("tight.yaml", tight)}).code, 0);
  const Ran strict = Remote({"session", "import", session_, "--robot", "tight", "--strict-limits"});
  EXPECT_EQ(strict.code, 3);
  EXPECT_THAT(strict.err, HasSubstr("its limit of"));
  EXPECT_EQ(At(OneObject(Remote({"session", "list", "--json"}).out), "sessions"), "[0]");
}

// Would catch a repeated import that fails or doubles, and two files mixed under one UUID.
TEST_F(RemoteTest, RepeatedImportIsHarmlessAndFilesAreNotMixed) {
  AddRobot();
  Import();
  Import();
  const std::string other = folder_.Path("other.csv");
  ASSERT_EQ(RunCli({"simulate", robot_, "--poses", "40", "--seed", "6", "--output", other}).code,
            0);
  EXPECT_EQ(Remote({"session", "import", other, "--robot", "ur10", "--session-id", kUuid, "--name",
                    "session.csv"})
                .code,
            3);
  EXPECT_EQ(At(OneObject(Remote({"session", "list", "--json"}).out), "sessions"), "[1]");
}

// Would catch a job without a wait that can't be found again.
TEST_F(RemoteTest, NoWaitGivesAJobToWatch) {
  AddRobot();
  Import();
  const auto job = OneObject(
      Remote({"calibrate", "--robot", "ur10", "--session", kUuid, "--no-wait", "--json"}).out);
  const Ran watched = Remote({"job", "watch", At(job, "name"), "--json"});
  EXPECT_EQ(watched.code, 0) << watched.err;
  EXPECT_EQ(At(OneObject(watched.out), "state"), "SUCCEEDED");
}

// Would catch a failed job reported as a success, or without its faults.
TEST_F(RemoteTest, AFailedJobIsTheSameErrorAsLocal) {
  AddRobot();
  const std::string few = folder_.Path("few.csv");
  ASSERT_EQ(RunCli({"simulate", robot_, "--poses", "3", "--output", few}).code, 0);
  ASSERT_EQ(Remote({"session", "import", few, "--robot", "ur10", "--session-id", kOtherUuid}).code,
            0);
  const Ran remote = Remote(
      {"calibrate", "--robot", "ur10", "--session", kOtherUuid, "--require-complete", "--json"});
  const Ran local = RunCli({"calibrate", "--local", "--robot", robot_, "--session", few,
                            "--require-complete", "--json"});
  EXPECT_EQ(remote.code, 3) << remote.err;
  EXPECT_EQ(local.code, 3) << local.err;
  EXPECT_EQ(At(OneObject(remote.out), "error.code"), At(OneObject(local.out), "error.code"));
  EXPECT_EQ(At(OneObject(remote.out), "error.message"), At(OneObject(local.out), "error.message"));
}

// Would catch an instrument that is given and whose expired certificate nobody hears of.
TEST_F(RemoteTest, ASessionSaysWhatMeasured) {
  AddRobot();
  Demand({"instrument", "create", "lt-1", "--set", "serial=7",
          "certificate_expire_time=2025-03-01T00:00:00Z"});
  Demand({"session", "import", session_, "--robot", "ur10", "--session-id", kUuid, "--instrument",
          "lt-1", "--operator", "Ada", "--temperature", "21.5"});
  const Ran shown = Demand({"session", "show", kUuid, "--json"});
  for (const char* part : {"instruments/lt-1", "Ada", "21.5"})
    EXPECT_THAT(shown.out, HasSubstr(part));
  const Ran report =
      Demand({"calibrate", "--robot", "ur10", "--session", kUuid, "--split", "even-odd"});
  EXPECT_THAT(report.out + report.err, HasSubstr("had expired on 2025-03-01"));
}

}  // namespace
}  // namespace truepose::cli
