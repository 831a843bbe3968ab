// `truepose program correct`: files in, files out, here and by a server.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_split.h"
#include "tests/cli/remote_fixture.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;

constexpr char kProgram[] =
    "# over the belt\r\ndef pick():\r\n  movej([0.3, -1.4, 1.3, -1.2, -1.1, 0.2], a=1.4)\r\n"
    "  movel(p[0.4, -0.3, 0.1, 0, 3.1, 0])\r\n  q = [0.5, -1.2, 1.1, -1.4, -1.3, 0.1]\r\n"
    "  movej(q)\r\nend\r\n";

class ProgramFilterTest : public RemoteFixture {
 protected:
  void SetUp() override {
    RemoteFixture::SetUp();
    ASSERT_EQ(RunCli({"calibrate", "--local", "--robot", robot_, "--session", session_, "--split",
                      "even-odd", "--output", calibration_})
                  .code,
              0);
    folder_.Write("pick.script", kProgram);
  }

  Ran Correct(std::vector<std::string> more, const std::string& program) const {
    std::vector<std::string> line = {"program", "correct", program,         "--local",
                                     "--robot", robot_,    "--calibration", calibration_};
    line.insert(line.end(), more.begin(), more.end());
    return RunCli(line);
  }
  Ran Correct(std::vector<std::string> more) const { return Correct(std::move(more), program_); }

  const std::string calibration_ = folder_.Path("calibration.json");
  const std::string program_ = folder_.Path("pick.script");
  const std::string output_ = folder_.Path("out.script");
};

// Would catch a program whose joints are not those that `compensate` gives for the same targets.
TEST_F(ProgramFilterTest, JointsAreThoseOfCompensate) {
  const Ran ran = Correct({"--output", output_, "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto answer = OneObject(ran.out);
  EXPECT_EQ(At(answer, "dialect"), "urscript");
  EXPECT_EQ(At(answer, "corrected"), "[2]");
  EXPECT_EQ(At(answer, "corrected.1.what"), "q");
  EXPECT_EQ(At(answer, "passed_through.0.line"), "4");
  EXPECT_EQ(At(answer, "passed_through.0.text"), "movel(p[0.4, -0.3, 0.1, 0, 3.1, 0])");
  const std::string targets = folder_.Write("t.csv",
                                            "q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n"
                                            "0.3,-1.4,1.3,-1.2,-1.1,0.2\n");
  const std::string corrected = folder_.Path("t2.csv");
  ASSERT_EQ(RunCli({"compensate", targets, "--local", "--robot", robot_, "--calibration",
                    calibration_, "--output", corrected})
                .code,
            0);
  // A header, then row, q1_rad, ... q6_rad with all their digits.
  const std::vector<std::string> cells = absl::StrSplit(
      std::vector<std::string>(absl::StrSplit(folder_.Read("t2.csv"), '\n'))[1], ',');
  const std::string text = folder_.Read("out.script");
  for (size_t j = 1; j <= 6; ++j)
    EXPECT_THAT(text, HasSubstr(absl::StrFormat("%.8f", std::stod(cells[j]))));
  EXPECT_THAT(text, HasSubstr("# over the belt\r\ndef pick():\r\n"));
  EXPECT_THAT(text, HasSubstr("  movel(p[0.4, -0.3, 0.1, 0, 3.1, 0])\r\n"));
  EXPECT_EQ(folder_.Read("pick.script"), kProgram);
}

// Would catch a program that is corrected twice, so that its robot is off by the whole correction,
// and a mark that hides from the diff or from `patch`.
TEST_F(ProgramFilterTest, ACorrectedProgramIsNotCorrectedAgain) {
  const Ran first = Correct({"--output", output_, "--diff"});
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("@@ -1,7 +1,8 @@\n+# corrected by truepose, calibration "));
  const std::string twice = folder_.Path("twice.script");
  const Ran again = Correct({"--output", twice}, output_);
  EXPECT_EQ(again.code, 3);
  EXPECT_THAT(again.err, HasSubstr("out.script:1: found a program that was corrected already, by "
                                   "calibration "));
  EXPECT_FALSE(std::filesystem::exists(twice));
  const Ran wanted = Correct({"--output", twice, "--again", "--json"}, output_);
  ASSERT_EQ(wanted.code, 0) << wanted.err;
  EXPECT_EQ(At(OneObject(wanted.out), "mark_line"), "1");
  const std::string text = folder_.Read("twice.script");
  EXPECT_NE(text.find("# corrected by truepose", 1), std::string::npos) << "both marks: " << text;
}

// Would catch a server that gives other joints than --local.
TEST_F(ProgramFilterTest, AServerGivesTheSameBytes) {
  ASSERT_EQ(Correct({"--output", output_}).code, 0);
  AddRobot();
  Import();
  Calibrate();
  const std::string other = folder_.Path("remote.script");
  Demand({"program", "correct", program_, "--calibration", "ur10#1", "--output", other});
  EXPECT_EQ(folder_.Read("remote.script"), folder_.Read("out.script"));
}

TEST_F(ProgramFilterTest, TextListsWhatStaysAndTheDiff) {
  const Ran ran = Correct({"--output", output_, "--diff"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("2 joint targets corrected, in " + output_));
  EXPECT_THAT(ran.out, HasSubstr("  line 4: a pose: the controller finds its joints"));
  EXPECT_THAT(ran.out, HasSubstr("-  movej([0.3, -1.4, 1.3, -1.2, -1.1, 0.2], a=1.4)\r\n+"));
}

// Would catch the only copy of a program being replaced, by whatever path.
TEST_F(ProgramFilterTest, NothingIsWrittenOverTheInput) {
  std::filesystem::create_symlink(program_, folder_.Path("link.script"));
  std::filesystem::create_hard_link(program_, folder_.Path("hard.script"));
  std::filesystem::create_directory(folder_.Path("d"));
  for (const char* name :
       {"pick.script", "./pick.script", "d/../pick.script", "link.script", "hard.script"}) {
    const Ran ran = Correct({"--output", folder_.Path(name)});
    EXPECT_EQ(ran.code, 3) << name;
    EXPECT_THAT(ran.err, HasSubstr("nothing is written over the input")) << name;
  }
  EXPECT_EQ(Correct({"--output", program_}, folder_.Path("link.script")).code, 3);
  EXPECT_EQ(folder_.Read("pick.script"), kProgram);
}

// Would catch half a program, and --keep-uncorrected that is silent.
TEST_F(ProgramFilterTest, ATargetBeyondItsLimitsRefusesTheFile) {
  const std::string tight = folder_.Write(
      "p.src",
      "PTP {A1 10,A2 -80,A3 70,A4 -60,A5 -50,A6 5}\nPTP {A1 900,A2 0,A3 0,A4 0,A5 0,A6 0}\n"
      "PTP {A1 0,A2 0}\n");
  const int before = folder_.FileCount();
  const Ran refused = Correct({"--output", folder_.Path("p2.src"), "--json"}, tight);
  EXPECT_EQ(refused.code, 3);
  const auto error = OneObject(refused.out);
  EXPECT_EQ(At(error, "error.faults"), "[1]");
  EXPECT_EQ(At(error, "error.faults.0.field"), absl::StrCat(tight, ":2"));
  EXPECT_THAT(At(error, "error.faults.0.found"), HasSubstr("beyond its limits"));
  EXPECT_EQ(folder_.FileCount(), before);
  const Ran kept =
      Correct({"--output", folder_.Path("p2.src"), "--keep-uncorrected", "--json"}, tight);
  EXPECT_EQ(kept.code, 0) << kept.err;
  EXPECT_THAT(kept.err, HasSubstr("mixes corrected and nominal motions"));
  EXPECT_EQ(At(OneObject(kept.out), "uncorrected.0.line"), "2");
  EXPECT_EQ(At(OneObject(kept.out), "passed_through.0.line"), "3");
  EXPECT_THAT(folder_.Read("p2.src"), HasSubstr("\nPTP {A1 900,A2 0,A3 0,A4 0,A5 0,A6 0}\n"));
}

// Would catch a singular wrist that is turned round, where millimetres cost tens of degrees.
TEST_F(ProgramFilterTest, ASmallLargestChangeRefuses) {
  const Ran ran = Correct({"--output", output_, "--largest-change", "0.000001"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("pick.script:3: movej: joint 1 would change by"));
  EXPECT_EQ(Correct({"--output", output_, "--largest-change", "0"}).code, 3);
}

TEST_F(ProgramFilterTest, DialectsAndFilesThatAreNone) {
  const std::string unknown = folder_.Write("pick.txt", kProgram);
  const Ran none = Correct({"--output", output_}, unknown);
  EXPECT_EQ(none.code, 3);
  EXPECT_THAT(none.err, HasSubstr("PROGRAM: found '"));
  EXPECT_EQ(Correct({"--output", output_, "--dialect", "basic"}, unknown).code, 3);
  EXPECT_EQ(Correct({"--output", output_, "--dialect", "urscript"}, unknown).code, 0);
  const Ran empty = Correct({"--output", output_, "--dialect", "krl"});
  EXPECT_EQ(empty.code, 0);
  EXPECT_THAT(empty.err, HasSubstr("no joint target was corrected"));
  EXPECT_EQ(folder_.Read("out.script"), kProgram);
  EXPECT_EQ(Correct({"--output", output_}, folder_.Path("none.script")).code, 3);
}

// Would catch a JSON object that no parser takes, because of a program's code page.
TEST_F(ProgramFilterTest, Latin1ProgramsHaveValidJson) {
  const std::string program = folder_.Write("p.src", "PTP XP\xDC ; \xFC\n");
  const Ran ran = Correct({"--output", folder_.Path("o.src"), "--diff", "--json"}, program);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(At(OneObject(ran.out), "passed_through.0.text"), HasSubstr("\xEF\xBF\xBD"));
}

}  // namespace
}  // namespace truepose::cli
