// Symptom: `--prior FILE` took calibrations that were edited or of another robot; and of an edited
// one `compensate` said "found nominal X, expected nominal X".
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/string_view.h"
#include "tests/cli/run.h"
#include "tests/cli/temp_folder.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class ForeignPrior : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(
        RunCli({"simulate", robot_, "--poses", "60", "--seed", "3", "--output", session_}).code, 0);
    ASSERT_EQ(Calibrate({"--output", prior_}).code, 0);
  }

  Ran Calibrate(std::vector<std::string> more) const {
    std::vector<std::string> line = {"calibrate", "--local", "--robot", robot_,
                                     "--session", session_,  "--split", "even-odd"};
    line.insert(line.end(), more.begin(), more.end());
    return RunCli(line);
  }
  Ran Recalibrate(const std::string& prior) const {
    return Calibrate({"--calibrate", "dq3", "--prior", prior});
  }
  Ran Compensate(const std::string& calibration) const {
    const std::string targets = folder_.Write(
        "targets.csv", "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n10,-80,70,-60,50,-40\n");
    return RunCli(
        {"compensate", targets, "--local", "--robot", robot_, "--calibration", calibration});
  }

  // The calibration with the first internal value's first digit after the point changed.
  std::string Edited() const {
    std::string text = folder_.Read("prior.json");
    size_t at = text.find("\"internal_parameters\"");
    at = text.find("\"value\"", at);
    at = text.find('.', at) + 1;
    text[at] = text[at] == '1' ? '2' : '1';
    return folder_.Write("edited.json", text);
  }

  const TempFolder folder_;
  const std::string robot_ = Example("ur10.yaml");
  const std::string session_ = folder_.Path("session.csv");
  const std::string prior_ = folder_.Path("prior.json");
};

TEST_F(ForeignPrior, UnchangedIsTaken) {
  const Ran ran = Recalibrate(prior_);
  EXPECT_EQ(ran.code, 0) << ran.err;
}

TEST_F(ForeignPrior, EditedIsRefused) {
  const Ran ran = Recalibrate(Edited());
  EXPECT_EQ(ran.code, 3) << ran.out;
  EXPECT_THAT(ran.err, HasSubstr("--prior: found a calibration that was edited"));
}

TEST_F(ForeignPrior, AnotherNominalIsRefused) {
  const std::string other = folder_.Write(
      "other.yaml", absl::StrReplaceAll(TextOf(robot_), {{"a_mm: -612", "a_mm: -613"}}));
  const Ran ran = RunCli({"calibrate", "--local", "--robot", other, "--session", session_,
                          "--calibrate", "dq3", "--prior", prior_});
  EXPECT_EQ(ran.code, 3) << ran.out;
  EXPECT_THAT(ran.err, HasSubstr("of another nominal revision"));
}

// One number once: an edited calibration is called that, not two equal revisions different.
TEST_F(ForeignPrior, CompensateNamesTheEdit) {
  const Ran ran = Compensate(Edited());
  EXPECT_EQ(ran.code, 3) << ran.out;
  EXPECT_THAT(ran.err, HasSubstr("was edited"));
  const size_t first = ran.err.find("sha256:");
  EXPECT_EQ(ran.err.find("sha256:", first + 1), std::string::npos) << ran.err;
}

// Catches: a verdict that limits the calibration and that nobody hears of who compensates.
TEST_F(ForeignPrior, CompensateTellsAVerdictThatLimits) {
  EXPECT_THAT(Compensate(prior_).err, Not(HasSubstr("within volume")));
  const std::string all = folder_.Path("all.json");
  ASSERT_EQ(
      RunCli({"calibrate", "--local", "--robot", robot_, "--session", session_, "--output", all})
          .code,
      0);
  const Ran ran = Compensate(all);  // no control rows: never more than apply_within_volume
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("apply within volume"));
  EXPECT_THAT(ran.err, HasSubstr("there is no control set"));
}

}  // namespace
}  // namespace truepose::cli
