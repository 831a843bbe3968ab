// What a job would identify, said without identifying it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "convert/run.h"
#include "core/base/fault.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

using ::testing::Contains;
using ::testing::Not;

std::vector<std::string> Identifiable(const v1::JobPreview& preview) {
  return {preview.identifiable().begin(), preview.identifiable().end()};
}

// Holds a preview against the run: the same parameters, counts and redundancies.
void ExpectAsTheRun(const v1::CalibrationInput& input) {
  const auto preview = RunPreview(input);
  ASSERT_TRUE(preview.ok()) << preview.status();
  const auto run = RunCalibration(input);
  ASSERT_TRUE(run.ok()) << run.status();
  const v1::CalibrationReport& report = run->report();
  std::vector<std::string> identified;
  for (const v1::ParameterValue& value : report.parameters().values())
    identified.push_back(value.name());
  EXPECT_EQ(Identifiable(*preview), identified);
  EXPECT_EQ(preview->counts().SerializeAsString(), report.counts().SerializeAsString());
  ASSERT_EQ(preview->redundancies_size(), report.redundancies_size());
  for (int i = 0; i < report.redundancies_size(); ++i) {
    EXPECT_EQ(preview->redundancies(i).SerializeAsString(),
              report.redundancies(i).SerializeAsString());
  }
}

// Catches a preview of another problem than the run's: other rows, other model, other measurement.
// The readings are good enough that the run drops nothing as too weak.
TEST(Preview, SaysWhatTheRunIdentifies) {
  const v1::CalibrationInput input = SampleInput(61);
  ExpectAsTheRun(input);
  EXPECT_EQ(RunPreview(input)->readings(), 61);
  EXPECT_EQ(RunPreview(input)->counts().rank(), 30);
}

TEST(Preview, OfPointsAndOfAnotherModel) {
  v1::CalibrationInput input = SampleInput();
  input.mutable_options()->set_observe(v1::POINT);
  ExpectAsTheRun(input);
  input.mutable_options()->set_model("extended_dh");
  ExpectAsTheRun(input);
}

// Catches a parameter that is named on both sides or without a reason, and ones that are held.
TEST(Preview, NamesWhatTheseReadingsDoNotTell) {
  v1::CalibrationInput input = SampleInput();
  const auto free = Identifiable(*RunPreview(input));
  v1::CalibrationInput internal_held = input;
  internal_held.mutable_options()->set_calibrate("external");
  const auto held = RunPreview(internal_held);
  ASSERT_TRUE(held.ok()) << held.status();
  EXPECT_EQ(held->identifiable_size(), 12) << "base and tool";
  EXPECT_GT(free.size(), 12u);
  const auto preview = RunPreview(input);
  for (const v1::Redundancy& redundancy : preview->redundancies()) {
    EXPECT_FALSE(redundancy.reason().empty());
    EXPECT_THAT(free, Not(Contains(redundancy.dropped())));
  }
}

// Catches a preview of what would be refused.
TEST(Preview, RefusesWhatTheRunRefuses) {
  v1::CalibrationInput input = SampleInput();
  input.mutable_options()->set_split("odd-even");
  input.mutable_options()->set_model("dh");
  const auto preview = RunPreview(input);
  EXPECT_EQ(preview.status(), RunCalibration(input).status());
  EXPECT_EQ(FaultsOf(preview.status()).size(), 2u);
  const v1::CalibrationInput few = SampleInput(2, "");
  EXPECT_EQ(RunPreview(few).status().code(), RunCalibration(few).status().code());
  EXPECT_FALSE(RunPreview(few).ok());
}

// Catches a preview that nobody can stop.
TEST(Preview, CanBeCancelled) {
  EXPECT_EQ(RunPreview(SampleInput(), {.on_progress = {}, .is_cancelled = [] { return true; }})
                .status()
                .code(),
            absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace truepose::convert
