// Real measured robots: the figures of the control set that the geometry allows. Everything from
// the files on: formats, conversion, split, start values, weights, identification. Would catch
// whatever makes a real robot worse.
#include <gtest/gtest.h>

#include "convert/run.h"
#include "formats/robot_file.h"
#include "formats/session_file.h"
#include "tests/core/testing/bench_problem.h"

namespace truepose {
namespace {

struct MeasuredRun {
  const char* robot;
  const char* session;
  const char* split;
  double position_mm, rotation_deg;
  int identified;
};

v1::CalibrationInput InputOf(const MeasuredRun& run) {
  v1::CalibrationInput input;
  const auto robot =
      formats::ReadRobotFile(std::string(TRUEPOSE_SOURCE_DIR "/deploy/examples/") + run.robot);
  EXPECT_TRUE(robot.ok()) << robot.status();
  *input.mutable_nominal() = robot->nominal;
  const auto session = formats::ReadSessionFile(testing::SharedFolder() + "/data/" + run.session,
                                                robot->nominal, {});
  EXPECT_TRUE(session.ok()) << session.status();
  *input.add_sessions()->mutable_session() = session->session;
  for (const v1::Reading& reading : session->readings)
    *input.mutable_sessions(0)->add_readings() = reading;
  input.mutable_options()->set_split(run.split);
  return input;
}

class MeasuredRobots : public ::testing::TestWithParam<MeasuredRun> {};

TEST_P(MeasuredRobots, ControlSet) {
  const MeasuredRun& run = GetParam();
  const auto calibration = convert::RunCalibration(InputOf(run));
  ASSERT_TRUE(calibration.ok()) << calibration.status();
  const v1::CalibrationReport& report = calibration->report();
  const v1::PoseStatistics& control = report.sets().control().after();
  EXPECT_LE(control.position_mm().rms(), run.position_mm);
  EXPECT_LE(control.rotation_deg().rms(), run.rotation_deg);
  EXPECT_EQ(report.parameters().identified(), run.identified);
  EXPECT_EQ(report.parameters().values_size(), run.identified);
  EXPECT_EQ(report.verdict(), "apply");
  EXPECT_LT(control.position_mm().rms(), report.sets().control().before().position_mm().rms());
  RecordProperty("position_rms_mm", std::to_string(control.position_mm().rms()));
}

INSTANTIATE_TEST_SUITE_P(
    Robots, MeasuredRobots,
    ::testing::Values(
        MeasuredRun{"ur10.yaml", "ipa_ur10/series_C.csv", "even-odd", 0.503, 0.060, 30},
        MeasuredRun{"ur10.yaml", "ipa_ur10/series_C.csv", "spaced:100", 0.512, 0.061, 30},
        MeasuredRun{"ur10.yaml", "ipa_ur10/series_D.csv", "even-odd", 0.430, 0.08, 30},
        MeasuredRun{"franka_panda.yaml", "philnad_panda/poses.csv", "even-odd", 1.50, 0.23, 34}),
    [](const auto& info) { return "Run" + std::to_string(info.index); });

// Same inputs, same bits: a second run, and a run that reports progress.
TEST(MeasuredRobotsTwice, SameBits) {
  const v1::CalibrationInput input =
      InputOf({"ur10.yaml", "ipa_ur10/series_D.csv", "even-odd", 0, 0, 0});
  convert::RunHooks hooks;
  double last = 0;
  hooks.on_progress = [&](const v1::JobProgress& progress) {
    EXPECT_GE(progress.fraction(), last) << "progress must not fall back";
    last = progress.fraction();
  };
  const auto a = convert::RunCalibration(input), b = convert::RunCalibration(input, hooks);
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_EQ(a->SerializeAsString(), b->SerializeAsString());
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace truepose
