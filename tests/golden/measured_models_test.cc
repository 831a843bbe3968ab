// Four models of one real robot: other parameters, the same robot. Would catch a model that is not
// complete (its control set is worse), one that can follow what a robot can't do (its calibration
// set is better), and an estimate that depends on the parametrisation.
#include <gtest/gtest.h>

#include <string>

#include "core/models/build_model.h"
#include "tests/golden/measured.h"

namespace truepose {
namespace {

struct MeasuredRun {
  const char* robot;
  const char* session;
  const char* split;
};

class FourModels : public ::testing::TestWithParam<MeasuredRun> {};

v1::CalibrationReport ReportOf(const MeasuredRun& run, const std::string& model) {
  v1::CalibrationInput input = testing::MeasuredInput(run.robot, run.session);
  input.mutable_options()->set_split(run.split);
  input.mutable_options()->set_model(model);
  return testing::MustCalibrate(input).report();
}

// 1e-4 mm and deg: the models differ by products of two errors (1e-3 rad x 0.5 mm = 5e-4 mm at one
// pose), and in the RMS over all poses these hardly show.
TEST_P(FourModels, SameControlSet) {
  const v1::CalibrationReport reference = ReportOf(GetParam(), "modified_incremental");
  for (const std::string& model : ModelKinds()) {
    SCOPED_TRACE(model);
    const v1::CalibrationReport report = ReportOf(GetParam(), model);
    EXPECT_EQ(report.model(), model);
    EXPECT_EQ(report.parameters().identified(), reference.parameters().identified());
    const auto same = [&](const v1::SetReport& set, const v1::SetReport& of) {
      EXPECT_NEAR(set.after().position_mm().rms(), of.after().position_mm().rms(), 1e-4);
      EXPECT_NEAR(set.after().rotation_deg().rms(), of.after().rotation_deg().rms(), 1e-4);
    };
    same(report.sets().control(), reference.sets().control());
    same(report.sets().calibration(), reference.sets().calibration());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Robots, FourModels,
    ::testing::Values(MeasuredRun{"ur10.yaml", "ipa_ur10/series_C.csv", "even-odd"},
                      MeasuredRun{"ur10.yaml", "ipa_ur10/series_C.csv", "spaced:100"},
                      MeasuredRun{"ur10.yaml", "ipa_ur10/series_D.csv", "even-odd"},
                      MeasuredRun{"franka_panda.yaml", "philnad_panda/poses.csv", "even-odd"}),
    [](const auto& info) { return "Run" + std::to_string(info.index); });

}  // namespace
}  // namespace truepose
