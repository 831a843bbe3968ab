// Symptoms: one control row gave "95 % interval 0.567 to 0.567 over 1 rows", which is no interval;
// and cross-validation of seven rows failed with "folds: found 10", which nobody had asked for.
#include <gtest/gtest.h>

#include "absl/strings/str_join.h"
#include "core/calibrate/calibrate.h"
#include "tests/core/testing/robots.h"
#include "tests/core/testing/simulated.h"

namespace truepose {
namespace {

using testing::Simulated;

SimulateOptions Session(int poses) {
  SimulateOptions options;
  options.poses = poses;
  options.seed = 2;
  return options;
}

// 40 rows calibrate, the others control.
CalibrationResult WithControlRows(int control) {
  const Simulated simulated(testing::Ur10(), testing::AnyTarget(), Session(40 + control));
  CalibrationProblem problem = simulated.Problem(ObservationKind::kPose, 0);
  for (int i = 40; i < 40 + control; ++i) problem.calibrates[static_cast<size_t>(i)] = false;
  const auto result = Calibrate(problem, {}, {});
  EXPECT_TRUE(result.ok()) << result.status();
  return result.ok() ? *result : CalibrationResult();
}

TEST(FewControlRows, BelowFiveThereIsNoInterval) {
  for (const int rows : {1, 4}) {
    const Verdict verdict = WithControlRows(rows).verdict;
    EXPECT_EQ(verdict.decision, Decision::kApplyWithinVolume);
    const std::string all = absl::StrJoin(verdict.reasons, "\n");
    EXPECT_EQ(all.find("95 % interval 0."), std::string::npos) << all;
    EXPECT_NE(all.find("needs 5 control rows, found " + std::to_string(rows)), std::string::npos)
        << all;
  }
  const std::string all = absl::StrJoin(WithControlRows(5).verdict.reasons, "\n");
  EXPECT_NE(all.find("95 % interval 0."), std::string::npos) << all;
}

// Catches: rows without an interval that pass whatever they show.
TEST(FewControlRows, AFewThatGotWorseAreNotApplied) {
  Identification identification;
  identification.summary.termination = Termination::kConverged;
  identification.set.active = {0};  // of the robot's own: there are no frames
  const std::vector<PoseError> small = {{0, 1e-4, -1}, {1, 2e-4, -1}},
                               large = {{0, 3e-4, -1}, {1, 2e-4, -1}};
  EXPECT_EQ(Judge(identification, ParameterSet(), small, large).decision, Decision::kDoNotApply);
  EXPECT_EQ(Judge(identification, ParameterSet(), large, small).decision,
            Decision::kApplyWithinVolume);
}

TEST(FewCalibrationRows, AreCrossValidatedOneByOne) {
  const Simulated simulated(testing::Ur10(), testing::AnyTarget(), Session(9));
  CalibrateOptions options;
  options.select = SelectionOptions{};
  options.select->criterion = SelectionCriterion::kCrossValidation;
  const auto result = Calibrate(simulated.Problem(ObservationKind::kPose, 0), options, {});
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_FALSE(result->selection.empty());
}

}  // namespace
}  // namespace truepose
