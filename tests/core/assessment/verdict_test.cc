// The verdict on results that no ratio of control errors gives away.
#include "core/assessment/verdict.h"

#include <gtest/gtest.h>

#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

// An improvement from 51 to 10 mm that the bootstrap takes for proved.
struct Improved {
  std::vector<PoseError> before, after;
  Improved() {
    for (int i = 0; i < 40; ++i) {
      before.push_back({i, 0.051 + 1e-4 * (i % 7), -1});
      after.push_back({i, 0.010 + 1e-4 * (i % 5), -1});
    }
  }
};

Verdict WithModelError(double position_sd_m, double rotation_sd_rad) {
  Identification identification;
  identification.model_error = {position_sd_m, rotation_sd_rad};
  identification.summary.termination = Termination::kConverged;
  identification.set.active = {0};  // without frames the first candidate is internal
  const Improved sets;
  return Judge(identification, ParameterSet(), sets.before, sets.after);
}

// Catches: a wrong minimum (distances, 51 mm before and after) that is applied since it is a little
// better than before, a limit on one of position and rotation only, a limit in the wrong unit.
TEST(Verdict, UnexplainedResidualsAreNotApplied) {
  for (const auto& [position, rotation] :
       {std::pair(5.1e-3, 1e-4), std::pair(0.05, 1e-3), std::pair(1e-4, 0.51 * testing::kDeg)}) {
    const Verdict verdict = WithModelError(position, rotation);
    EXPECT_EQ(verdict.decision, Decision::kDoNotApply) << position << " " << rotation;
    ASSERT_EQ(verdict.reasons.size(), 2u);
    for (const char* word : {"units", "order of the joints", "anchors", "robot file"})
      EXPECT_NE(verdict.reasons[1].find(word), std::string::npos) << verdict.reasons[1];
  }
}

// The worst of the measured robots leaves 0.8 mm; catches a limit that a real arm meets.
TEST(Verdict, WhatRealRobotsLeaveIsApplied) {
  for (const auto& [position, rotation] :
       {std::pair(8e-4, 2e-3), std::pair(4.9e-3, 0.49 * testing::kDeg)}) {
    const Verdict verdict = WithModelError(position, rotation);
    EXPECT_EQ(verdict.decision, Decision::kApply) << position << " " << rotation;
    EXPECT_EQ(verdict.reasons.size(), 1u);
  }
}

Verdict OfRatio(double ratio, const std::vector<int>& active) {
  Identification identification;
  identification.summary.termination = Termination::kConverged;
  identification.estimate.X_MB.resize(1);
  identification.estimate.X_FT.resize(1);
  identification.set.active = active;
  const Improved sets;
  std::vector<PoseError> after = sets.before;
  for (PoseError& error : after) error.position_m *= ratio;
  return Judge(identification, ParameterSet(), sets.before, after);
}

// Catches "apply" for a fit of base and tool alone, whose errors before and after differ by 1e-7 of
// themselves; and a margin so wide that a real gain of a thousandth is refused.
TEST(Verdict, RoundOffIsNoImprovement) {
  EXPECT_EQ(OfRatio(1 - 1e-7, {0, 12}).decision, Decision::kDoNotApply);
  EXPECT_EQ(OfRatio(1, {0, 12}).decision, Decision::kDoNotApply);
  EXPECT_EQ(OfRatio(0.999, {0, 12}).decision, Decision::kApply);
}

// Catches a calibration of base and tool that is sent to the robot; index 12 is the first internal
// candidate beside one base and one tool.
TEST(Verdict, NothingOfTheRobot) {
  const Verdict verdict = OfRatio(0.5, {0, 11});
  EXPECT_EQ(verdict.decision, Decision::kDoNotApply);
  EXPECT_NE(verdict.reasons.back().find("nothing of the robot was identified"), std::string::npos);
  EXPECT_EQ(OfRatio(0.5, {0, 11, 12}).decision, Decision::kApply);
}

// Catches advice on units for a run that merely did not converge.
TEST(Verdict, NotConvergedSaysWhatToTry) {
  Identification identification;
  identification.summary.termination = Termination::kIterationLimit;
  identification.set.active = {0};
  const Improved sets;
  const Verdict verdict = Judge(identification, ParameterSet(), sets.before, sets.after);
  EXPECT_EQ(verdict.decision, Decision::kDoNotApply);
  EXPECT_NE(verdict.reasons.back().find("levenberg_marquardt"), std::string::npos);
  EXPECT_EQ(verdict.reasons.back().find("units"), std::string::npos);
}

}  // namespace
}  // namespace truepose
