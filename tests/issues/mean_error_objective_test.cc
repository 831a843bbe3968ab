// Symptom: `--estimator simplex --objective e_op` on full poses left orientations two degrees off
// and said nothing of it: the chapter's mean error is one of positions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

TEST(MeanErrorObjective, SaysThatOrientationsWereLeftOut) {
  v1::CalibrationInput input = SampleInput(40);
  input.mutable_options()->set_estimator("simplex");
  input.mutable_options()->set_objective("e_op");
  const auto calibration = RunCalibration(input);
  ASSERT_TRUE(calibration.ok()) << calibration.status();
  EXPECT_THAT(calibration->report().warnings(),
              ::testing::Contains(::testing::HasSubstr("fits positions alone")));
}

}  // namespace
}  // namespace truepose::convert
