// Symptom: targets near a singularity, or in degrees under a heading of radians, were corrected by
// tens of degrees, and nothing was said but in the columns of a table of which the file has none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/strings/str_cat.h"
#include "tests/cli/run.h"
#include "tests/cli/temp_folder.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class FarJoints : public ::testing::Test {
 protected:
  void SetUp() override {
    const Ran ran = RunCli({"simulate", robot_, "--poses", "10", "--seed", "3", "--output",
                            folder_.Path("s.csv"), "--truth", truth_});
    ASSERT_EQ(ran.code, 0) << ran.err;
  }
  // @param rows under a heading of degrees
  Ran Compensate(const std::string& rows) const {
    const std::string targets = folder_.Write(
        "targets.csv", absl::StrCat("q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n", rows));
    return RunCli({"compensate", targets, "--local", "--robot", robot_, "--calibration", truth_,
                   "--output", folder_.Path("out.csv")});
  }

  const TempFolder folder_;
  const std::string robot_ = Example("ur10.yaml"), truth_ = folder_.Path("truth.json");
  // A wrist that is nearly straight, where joints 4 and 6 turn by much against each other.
  static constexpr char kGood[] = "10,-80,70,-60,50,-40\n", kWrist[] = "10,-80,70,-60,0.3,-40\n";
};

TEST_F(FarJoints, AreSaidOnceWithRowAndJoint) {
  const Ran ran = Compensate(absl::StrCat(kGood, kWrist, kWrist));
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("warning: 2 targets with a joint that changes by more than 5.0 "
                                 "deg; the first is target 1, q"));
  EXPECT_THAT(ran.err, HasSubstr("near a singularity, or its numbers are in other units"));
  EXPECT_EQ(ran.err.find("a joint that changes"), ran.err.rfind("a joint that changes"));
}

// Of a straight wrist 1e-13 mm are left, which reads as solved; of a stretched elbow 0.5 mm are.
TEST_F(FarJoints, ASingularRefusalHasFiguresWhereSomethingIsLeft) {
  const Ran wrist = Compensate("10,-80,70,-60,0,-40\n");
  EXPECT_EQ(wrist.code, 3);
  EXPECT_THAT(wrist.err, HasSubstr("near a singularity: joints would have to move far"));
  const Ran elbow = Compensate("10,-80,0,-60,50,-40\n");
  EXPECT_EQ(elbow.code, 3);
  EXPECT_THAT(elbow.err, HasSubstr("near a singularity (at best 0."));
}

TEST_F(FarJoints, OrdinaryCorrectionsAreNotWarnedOf) {
  EXPECT_THAT(Compensate(kGood).err, Not(HasSubstr("changes by more")));
}

}  // namespace
}  // namespace truepose::cli
