// Symptoms: "apply" for a calibration of base and tool alone; `--calibrate dq1` that found no dq1
// and said nothing; effects that were left out in silence; 20 of 27 correlations not named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/fault.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

// Base and tool alone change nothing of the robot, so it is not to be applied, whatever round-off
// makes of the ratio.
TEST(External, IsNotApplied) {
  v1::CalibrationInput input = SampleInput(80);
  input.mutable_options()->set_calibrate("external");
  const auto calibration = RunCalibration(input);
  ASSERT_TRUE(calibration.ok()) << calibration.status();
  EXPECT_EQ(calibration->report().verdict(), "do_not_apply");
  EXPECT_THAT(calibration->report().verdict_reasons(),
              Contains(HasSubstr("nothing of the robot was identified")));
}

// A turn of joint 1 is one of the base; a parameter that was asked for by name and can't be found
// is refused without a prior as it is with one.
TEST(Named, IsRefusedWhenTheBaseTakesItUp) {
  v1::CalibrationInput input = SampleInput(80);
  input.mutable_options()->set_calibrate("dq1");
  const absl::Status status = RunCalibration(input).status();
  ASSERT_EQ(FaultsOf(status).size(), 1u) << status;
  EXPECT_EQ(FaultsOf(status)[0].field, "options.calibrate");
  EXPECT_THAT(FaultsOf(status)[0].found, HasSubstr("dq1"));
  input.mutable_options()->set_calibrate("dq3");
  EXPECT_TRUE(RunCalibration(input).ok());
}

// Every group is in the table or named with its reason, the missing torque with its row.
TEST(AutoEffects, NamesWhatWasNotTried) {
  v1::CalibrationInput input = SampleInput(60);
  input.mutable_options()->set_effects("auto");
  for (v1::Reading& reading : *input.mutable_sessions(0)->mutable_readings())
    for (int j = 0; j < 6 && reading.row() != 8; ++j)
      reading.add_joint_torques_nm(j + reading.row() % 7);
  const auto calibration = RunCalibration(input);
  ASSERT_TRUE(calibration.ok()) << calibration.status();
  EXPECT_THAT(
      calibration->report().warnings(),
      Contains(AllOf(HasSubstr("effects not tried"), HasSubstr("missing in 1 of 30 readings"),
                     HasSubstr("row 8"), HasSubstr("temperature (there is no temperature"),
                     HasSubstr("gain (30 readings give 180 values, 324 needed"))));
}

// All pairs above 0.8 by the covariance itself, also those of base and tool.
TEST(Correlations, AreAllNamed) {
  const auto calibration = RunCalibration(SampleInput(60));
  ASSERT_TRUE(calibration.ok()) << calibration.status();
  const int n = calibration->report().parameters().values_size();
  const auto covariance = [&](int i, int j) { return calibration->covariance(i * n + j); };
  int pairs = 0;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      pairs += std::abs(covariance(i, j)) > 0.8 * std::sqrt(covariance(i, i) * covariance(j, j));
  EXPECT_GT(pairs, 0);
  EXPECT_EQ(calibration->report().correlations_size(), pairs);
}

}  // namespace
}  // namespace truepose::convert
