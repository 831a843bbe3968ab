// `--local`: files in, a report out, on small simulated sessions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/str_split.h"
#include "tests/cli/run.h"
#include "tests/cli/temp_folder.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;

// A UR10 with errors of half a millimetre, measured to 0.05 mm in 60 poses.
class LocalTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const Ran ran = RunCli({"simulate", robot_, "--poses", "60", "--seed", "3", "--output",
                            session_, "--truth", folder_.Path("truth.json")});
    ASSERT_EQ(ran.code, 0) << ran.err;
  }

  Ran Calibrate(std::vector<std::string> more, const std::string& session) const {
    std::vector<std::string> line = {"calibrate", "--local",   "--robot",
                                     robot_,      "--session", session};
    line.insert(line.end(), more.begin(), more.end());
    return RunCli(line);
  }
  Ran Calibrate(std::vector<std::string> more) const {
    return Calibrate(std::move(more), session_);
  }

  std::string WriteCalibration() const {
    const std::string path = folder_.Path("calibration.json");
    const Ran ran = Calibrate({"--split", "even-odd", "--output", path});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return path;
  }

  const TempFolder folder_;
  const std::string robot_ = Example("ur10.yaml");
  const std::string session_ = folder_.Path("session.csv");
};

// Would catch a report of another shape than programs were promised.
TEST_F(LocalTest, JsonHasTheDocumentedShape) {
  const Ran ran = Calibrate({"--split", "even-odd", "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto report = OneObject(ran.out);
  EXPECT_EQ(At(report, "model"), "modified_incremental");
  EXPECT_EQ(At(report, "estimator"), "levenberg_marquardt");
  EXPECT_EQ(At(report, "parameters.identified"), "30");
  for (const char* field : {"name", "nominal", "identified", "sd", "unit"}) {
    EXPECT_NE(At(report, std::string("parameters.values.0.") + field), "");
  }
  for (const char* set : {"calibration", "control", "complete"}) {
    EXPECT_NE(At(report, std::string("sets.") + set + ".poses"), "0");
    for (const char* when : {".before.", ".after."}) {
      for (const char* what : {"position_mm.", "rotation_deg."}) {
        for (const char* figure : {"mean", "sd", "rms", "max"}) {
          EXPECT_NE(At(report, std::string("sets.") + set + when + what + figure), "");
        }
      }
    }
  }
  EXPECT_NE(At(report, "redundancies"), "[0]");
  EXPECT_NE(At(report, "verdict"), "");
  EXPECT_EQ(At(report, "summary.termination"), "converged");
}

// Would catch a result that depends on anything but its inputs.
TEST_F(LocalTest, SameInputsGiveTheSameBytes) {
  EXPECT_EQ(Calibrate({"--split", "random:5", "--json"}).out,
            Calibrate({"--split", "random:5", "--json"}).out);
}

// Would catch a lost section of the report.
TEST_F(LocalTest, TextHasEverySection) {
  const Ran ran = Calibrate({"--split", "even-odd"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  for (const char* part : {"Model modified_incremental", "Residuals\n", "control", "Parameters\n",
                           "dq2", "Parameters that stay at nominal",
                           "Position residuals of the control rows in mm", "Verdict: ", "Next: "}) {
    EXPECT_THAT(ran.out, HasSubstr(part));
  }
  for (const char c : ran.out)
    ASSERT_GE(static_cast<signed char>(c), 0) << "not ASCII in a locale without UTF-8";
}

// Would catch a --output file that the other commands can't use, and a compensation that is none.
TEST_F(LocalTest, OutputServesEvaluateAndCompensate) {
  const std::string calibration = WriteCalibration();
  const Ran evaluated = RunCli({"evaluate", "--local", "--robot", robot_, "--calibration",
                                calibration, "--session", session_, "--json"});
  ASSERT_EQ(evaluated.code, 0) << evaluated.err;
  const auto evaluation = OneObject(evaluated.out);
  EXPECT_EQ(At(evaluation, "set.poses"), "60");
  EXPECT_GT(std::stod(At(evaluation, "set.before.position_mm.rms")), 0.3);
  EXPECT_LT(std::stod(At(evaluation, "set.after.position_mm.rms")), 0.15);
  const std::string targets = folder_.Write("targets.csv",
                                            "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n"
                                            "10,-80,70,-60,50,-40\n0,-90,90,0,90,0\n");
  const Ran compensated =
      RunCli({"compensate", targets, "--local", "--robot", robot_, "--calibration", calibration,
              "--output", folder_.Path("corrected.csv")});
  ASSERT_EQ(compensated.code, 0) << compensated.err;
  EXPECT_THAT(folder_.Read("corrected.csv"), HasSubstr("q1_rad"));
  const Ran table =
      RunCli({"compensate", targets, "--local", "--robot", robot_, "--calibration", calibration});
  EXPECT_THAT(table.out, HasSubstr("q1 deg"));
  const Ran json = RunCli({"compensate", targets, "--local", "--robot", robot_, "--calibration",
                           calibration, "--json"});
  const double correction = std::stod(At(OneObject(json.out), "targets.0.position_correction_mm"));
  EXPECT_GT(correction, 0.01);
  EXPECT_LT(correction, 10.0);
}

// Would catch a calibration applied to a robot from which it was not made.
TEST_F(LocalTest, CalibrationOfAnotherRobotIsRefused) {
  const std::string calibration = WriteCalibration();
  const std::string other =
      folder_.Write("other.yaml", absl::StrReplaceAll(TextOf(robot_), {{"127.3", "128.3"}}));
  const std::string targets =
      folder_.Write("t.csv", "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n0,-90,90,0,90,0\n");
  const Ran ran =
      RunCli({"compensate", targets, "--local", "--robot", other, "--calibration", calibration});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("--robot: found " + other));
}

// Would catch a program with some targets missing that looks whole.
TEST_F(LocalTest, TargetOutOfReachLeavesNoFile) {
  const std::string calibration = WriteCalibration();
  const std::string targets =
      folder_.Write("far.csv", "x_mm,y_mm,z_mm,qx,qy,qz,qw\n9000,0,0,0,0,0,1\n");
  const int before = folder_.FileCount();
  const Ran ran = RunCli({"compensate", targets, "--local", "--robot", robot_, "--calibration",
                          calibration, "--output", folder_.Path("corrected.csv"), "--json"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(At(OneObject(ran.out), "error.faults.0.field"), HasSubstr("far.csv: target 0"));
  EXPECT_EQ(folder_.FileCount(), before);
}

// Would catch faults told one at a time, without file and line, or a result written in spite of
// them.
TEST_F(LocalTest, FaultsOfASessionComeTogetherAndLeaveNothing) {
  const std::string bad = folder_.Write("bad.csv",
                                        "q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,x_mm,y_mm,z_mm\n"
                                        "0,0,0,0,0,nan,1,2,3\n"
                                        "0,0,0,0,0,0,1,two,3\n");
  const int before = folder_.FileCount();
  const Ran ran = Calibrate({"--output", folder_.Path("c.json"), "--json"}, bad);
  EXPECT_EQ(ran.code, 3);
  const auto error = OneObject(ran.out);
  EXPECT_EQ(At(error, "error.faults"), "[2]");
  EXPECT_THAT(At(error, "error.faults.0.field"), HasSubstr("bad.csv:2: q6_rad"));
  EXPECT_THAT(At(error, "error.faults.1.field"), HasSubstr("bad.csv:3: y_mm"));
  EXPECT_EQ(folder_.FileCount(), before);
}

// Would catch faults of options hidden behind those of files, and message fields where people typed
// options.
TEST_F(LocalTest, FaultsOfRobotAndOptionsComeTogether) {
  const Ran ran = RunCli({"calibrate", "--local", "--robot", folder_.Path("none.yaml"), "--session",
                          session_, "--split", "odd-even", "--json"});
  EXPECT_EQ(ran.code, 3);
  const auto error = OneObject(ran.out);
  EXPECT_EQ(At(error, "error.faults"), "[2]");
  EXPECT_EQ(At(error, "error.faults.1.field"), "--split");
  EXPECT_EQ(At(error, "error.faults.1.found"), "'odd-even'");
}

// Would catch a split, group or tool that does not exist being ignored.
TEST_F(LocalTest, UnknownColumnsAndToolsAreFaultsOfTheirOptions) {
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--group", "nothing"},
                                               {"--split", "column:nothing=1"},
                                               {"--tool", "nothing"}}) {
    const Ran ran = Calibrate(more);
    EXPECT_EQ(ran.code, 3) << more[0];
    EXPECT_THAT(ran.err, HasSubstr(more[0] + ": found")) << ran.err;
  }
}

// Would catch a bad place for the result that is told after the work, or a run that leaves half a
// file.
TEST_F(LocalTest, BadOutputIsToldFirst) {
  const Ran ran = Calibrate({"--output", folder_.Path("no/such/folder/c.json")});
  EXPECT_EQ(ran.code, 3);
  EXPECT_EQ(ran.out, "");
  EXPECT_THAT(ran.err, HasSubstr("--output: found"));
}

// Would catch joint limits that are not looked at, and --strict-limits that only warns.
TEST_F(LocalTest, LimitsWarnAndStrictLimitsFail) {
  const std::string tight = folder_.Write(
      "tight.yaml", absl::StrReplaceAll(TextOf(robot_), {{"-360", "-1"}, {"360", "1"}}));
  std::vector<std::string> line = {"calibrate", "--local", "--robot", tight, "--session", session_};
  EXPECT_THAT(RunCli(line).out, HasSubstr("its limit of"));
  line.insert(line.end(), {"--strict-limits", "--json"});
  const Ran strict = RunCli(line);
  EXPECT_EQ(strict.code, 3);
  EXPECT_THAT(At(OneObject(strict.out), "error.faults.0.found"), HasSubstr("its limit of"));
}

// Would catch readings that leave parameters open being taken for a complete calibration.
TEST_F(LocalTest, RequireCompleteFailsWhereReadingsDoNotSuffice) {
  const std::string text = folder_.Read("session.csv");
  std::vector<std::string> lines = absl::StrSplit(text, '\n');
  lines.resize(4);
  const std::string few = folder_.Write("few.csv", absl::StrJoin(lines, "\n") + "\n");
  const Ran ran = Calibrate({"--require-complete"}, few);
  EXPECT_EQ(ran.code, 3) << ran.err;
  EXPECT_EQ(ran.out, "");
}

// Would catch an objective that other estimators take and ignore.
TEST_F(LocalTest, AnObjectiveNeedsTheSimplex) {
  const Ran ran = Calibrate({"--objective", "e_op"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("--objective: found 'e_op' with estimator levenberg_marquardt, "
                                 "expected estimator simplex"));
}

// Would catch a parser's complaint about a file that was never JSON.
TEST_F(LocalTest, APriorThatIsNoCalibrationIsToldWhatMayStandThere) {
  for (const std::string& prior : {session_, folder_.Path("none.json")}) {
    const Ran ran = Calibrate({"--prior", prior});
    EXPECT_EQ(ran.code, 3);
    EXPECT_THAT(ran.err, HasSubstr("--prior: found '" + prior + "'"));
    EXPECT_THAT(ran.err, HasSubstr("expected none, tolerance, or a file with the JSON"));
  }
}

// Would catch a warning that says the opposite of what the options do.
TEST_F(LocalTest, ColumnsThatOptionsNameAreNotCalledUnused) {
  std::vector<std::string> lines = absl::StrSplit(folder_.Read("session.csv"), '\n');
  lines[0] += ",day,shift,note";
  for (size_t i = 1; i + 1 < lines.size(); ++i) lines[i] += i % 2 ? ",1,a,x" : ",2,b,x";
  const std::string session = folder_.Write("named.csv", absl::StrJoin(lines, "\n"));
  const Ran ran = Calibrate({"--split", "column:day=2", "--group", "shift"}, session);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("kept but not used: note\n"));
}

// Would catch contacts without their fixture that are told as an empty session.
TEST_F(LocalTest, ContactsAskForTheirFixture) {
  const std::string joints = "q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad";
  for (const char* column : {"feature", "hole"}) {
    const std::string session =
        folder_.Write("contacts.csv", joints + "," + column + "\n0,0,0,0,0,0,a\n1,0,0,0,0,0,a\n");
    const Ran ran = Calibrate({}, session);
    EXPECT_EQ(ran.code, 3);
    EXPECT_THAT(ran.err, HasSubstr("--fixture FILE"));
  }
}

// A round through another model and back into evaluate: would catch a file that other commands
// refuse, and a prediction that moved.
TEST_F(LocalTest, AConvertedCalibrationServesAsTheOriginal) {
  const std::string calibration = WriteCalibration(), converted = folder_.Path("dh.json");
  const Ran ran = RunCli({"calibration", "convert", calibration, "--robot", robot_, "--model",
                          "extended_dh", "--output", converted});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("in extended_dh\n"));
  EXPECT_THAT(ran.out, HasSubstr("converted from modified_incremental"));
  const auto evaluate = [&](const std::string& file) {
    const Ran evaluated = RunCli({"evaluate", "--local", "--robot", robot_, "--calibration", file,
                                  "--session", session_, "--json"});
    EXPECT_EQ(evaluated.code, 0) << evaluated.err;
    return std::stod(At(OneObject(evaluated.out), "set.after.position_mm.rms"));
  };
  EXPECT_NEAR(evaluate(converted), evaluate(calibration), 1e-6);
  const Ran json = RunCli({"calibration", "convert", calibration, "--robot", robot_, "--model",
                           "incremental", "--json"});
  EXPECT_EQ(At(OneObject(json.out), "report.model"), "incremental");
  const Ran unknown =
      RunCli({"calibration", "convert", calibration, "--robot", robot_, "--model", "dh"});
  EXPECT_EQ(unknown.code, 3);
  EXPECT_THAT(unknown.err, HasSubstr("--model: found 'dh'"));
  EXPECT_EQ(RunCli({"calibration", "convert", calibration, "--model", "dh"}).code, 2);
}

// A robot without errors can't be improved: the report says not to apply, names no way on to
// compensation, and compensate refuses the file.
TEST_F(LocalTest, DoNotApplyDoesNotReachARobot) {
  const std::string session = folder_.Path("exact.csv"), calibration = folder_.Path("exact.json");
  ASSERT_EQ(RunCli({"simulate", robot_, "--poses", "60", "--length-error-mm", "0",
                    "--angle-error-deg", "0", "--output", session})
                .code,
            0);
  const Ran ran = Calibrate({"--split", "even-odd", "--output", calibration}, session);
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("Next: find the cause first"));
  // One exit code, whatever the command: a fault of the input.
  const std::string output = folder_.Path("out"), cell = Example("ur10_cell.yaml"),
                    program = folder_.Write("p.src", "PTP {A1 1,A2 -80,A3 70,A4 9,A5 50,A6 0}\n");
  for (std::vector<std::string> line :
       std::vector<std::vector<std::string>>{{"compensate", Example("ur10_targets.csv")},
                                             {"program", "correct", program, "--output", output},
                                             {"table", "build", "--spec", cell, "--output", output},
                                             {"accuracy-map", "--spec", cell}}) {
    line.insert(line.end(), {"--local", "--robot", robot_, "--calibration", calibration});
    const Ran refused = RunCli(line);
    EXPECT_EQ(refused.code, 3) << line[0];
    EXPECT_EQ(refused.out, "") << line[0];
    EXPECT_THAT(refused.err, HasSubstr("--calibration: report.verdict: found do_not_apply"));
  }
}

}  // namespace
}  // namespace truepose::cli
