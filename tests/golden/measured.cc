#include "tests/golden/measured.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "absl/strings/str_format.h"
#include "convert/run.h"
#include "formats/robot_file.h"
#include "formats/session_file.h"
#include "tests/core/testing/table.h"

namespace truepose::testing {
namespace {

v1::CalibrationInput ReadInput(const std::string& robot_file, const std::string& session_file) {
  v1::CalibrationInput input;
  const auto robot =
      formats::ReadRobotFile(std::string(TRUEPOSE_SOURCE_DIR "/deploy/examples/") + robot_file);
  EXPECT_TRUE(robot.ok()) << robot.status();
  if (!robot.ok()) return input;
  *input.mutable_nominal() = robot->nominal;
  const auto session =
      formats::ReadSessionFile(SharedFolder() + "/data/" + session_file, robot->nominal, {});
  EXPECT_TRUE(session.ok()) << session.status();
  if (!session.ok()) return input;
  *input.add_sessions()->mutable_session() = session->session;
  for (const v1::Reading& reading : session->readings)
    *input.mutable_sessions(0)->add_readings() = reading;
  return input;
}

}  // namespace

v1::CalibrationInput MeasuredInput(const std::string& robot, const std::string& session) {
  static auto* const inputs = new std::map<std::string, v1::CalibrationInput>;
  const auto [input, is_new] = inputs->try_emplace(robot + " " + session);
  if (is_new) input->second = ReadInput(robot, session);
  return input->second;
}

v1::Calibration MustCalibrate(const v1::CalibrationInput& input) {
  const auto calibration = convert::RunCalibration(input);
  EXPECT_TRUE(calibration.ok()) << calibration.status();
  return calibration.ok() ? *calibration : v1::Calibration();
}

double ControlRms(const v1::Calibration& calibration) {
  return calibration.report().sets().control().after().position_mm().rms();
}

std::string VerdictOf(const v1::Calibration& calibration) {
  std::string text = calibration.report().verdict();
  for (const std::string& reason : calibration.report().verdict_reasons()) text += "; " + reason;
  return text;
}

std::string RandomSplit(int seed, int calibrate, int rows) {
  return absl::StrFormat("random:%d:%.10f", seed, static_cast<double>(calibrate) / rows);
}

double MedianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

}  // namespace truepose::testing
