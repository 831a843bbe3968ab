// Symptom: `--calibrate all,nonsense,dq77` and `--effects ,` ran as if nothing was wrong with them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "convert/run.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string FaultOf(const std::string& calibrate, const std::string& effects) {
  v1::CalibrationInput input = SampleInput(30);
  input.mutable_options()->set_calibrate(calibrate);
  input.mutable_options()->set_effects(effects);
  const auto calibration = RunCalibration(input, {});
  EXPECT_EQ(calibration.status().code(), absl::StatusCode::kInvalidArgument)
      << calibration.status();
  return std::string(calibration.status().message());
}

TEST(UnknownWords, BesideAllAreFaults) {
  EXPECT_THAT(FaultOf("all,nonsense,dq77", ""),
              AllOf(HasSubstr("options.calibrate"), HasSubstr("'nonsense'"), HasSubstr("'dq77'")));
  EXPECT_THAT(FaultOf("nonsense,internal", ""), HasSubstr("'nonsense'"));
}

TEST(UnknownWords, AListOfNothingIsAFault) {
  EXPECT_THAT(FaultOf(",", ""), AllOf(HasSubstr("options.calibrate"), HasSubstr("empty list")));
  EXPECT_THAT(FaultOf("", ","), AllOf(HasSubstr("options.effects"), HasSubstr("empty list")));
  EXPECT_THAT(FaultOf("", " , "), HasSubstr("options.effects"));
}

// What was right stays right: known names beside all.
TEST(UnknownWords, KnownWordsBesideAllAreAll) {
  v1::CalibrationInput input = SampleInput(30);
  input.mutable_options()->set_calibrate("all,dq2");
  EXPECT_TRUE(RunCalibration(input, {}).ok());
}

}  // namespace
}  // namespace truepose::convert
