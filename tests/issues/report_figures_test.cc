// Figures of a report that were not those of the calibration.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/geometry/pose.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

v1::Calibration MustRun(const v1::CalibrationInput& input) {
  auto calibration = RunCalibration(input, {});
  EXPECT_TRUE(calibration.ok()) << calibration.status();
  return *std::move(calibration);
}

// Turns readings into lengths of six beams with constants of their own, from four known anchors.
void SeeBeams(v1::CalibrationInput* input) {
  const Eigen::Vector3d anchors[] = {
      {0.5, 0.5, 0.1}, {1, -0.7, 0.3}, {-0.6, 0.9, 0.8}, {0.2, 0.2, 1.5}};
  for (int k = 0; k < 4; ++k) {
    v1::Feature* feature = input->mutable_options()->mutable_fixture()->add_features();
    feature->set_name("anchor " + std::to_string(k));
    feature->set_kind(v1::FEATURE_POINT);
    v1::Pose* pose = feature->mutable_pose();
    pose->set_x_m(anchors[k].x());
    pose->set_y_m(anchors[k].y());
    pose->set_z_m(anchors[k].z());
    pose->set_qw(1);
  }
  int i = 0;
  for (v1::Reading& reading : *input->mutable_sessions(0)->mutable_readings()) {
    const v1::Vector3& p = reading.position_m();
    const int beam = i / 4 % 6;
    reading.set_distance_m((Eigen::Vector3d(p.x(), p.y(), p.z()) - anchors[i % 4]).norm() +
                           0.3 * (beam - 2));
    reading.set_anchor("anchor " + std::to_string(i % 4));
    reading.set_beam("beam " + std::to_string(beam));
    reading.clear_position_m();
    reading.clear_orientation();
    ++i;
  }
}

// From the fourth constant on the deviations were mixed as if three constants were a rotation.
TEST(ReportFigures, DeviationsOfConstantsAreThoseOfTheCovariance) {
  v1::CalibrationInput input = SampleInput(240, "");
  SeeBeams(&input);
  const v1::Calibration calibration = MustRun(input);
  const auto& values = calibration.report().parameters().values();
  int constants = 0;
  for (int i = 0; i < values.size(); ++i) {
    const std::string& name = values[i].name();
    if (values[i].group() == v1::INTERNAL || name.rfind("base", 0) == 0 ||
        name.rfind("tool", 0) == 0)
      continue;
    ++constants;
    const double sd = 1e3 * std::sqrt(calibration.covariance(i * values.size() + i));
    EXPECT_NEAR(values[i].sd(), sd, 1e-9 * sd) << name;
  }
  EXPECT_EQ(constants, 6);
}

// Four visits of one group at one place and two at another: seven pairs. One visit is alone.
v1::CalibrationInput Visited(bool backwards) {
  v1::CalibrationInput input = SampleInput(60);
  auto* readings = input.mutable_sessions(0)->mutable_readings();
  const auto visit = [&](int of, double x) {
    v1::Reading again = readings->Get(of);
    again.mutable_position_m()->set_x(again.position_m().x() + x);
    *readings->Add() = again;
  };
  for (const double x : {1e-4, 2e-4, 4e-4}) visit(0, x);
  visit(1, 3e-4);
  for (const int row : {0, 1, 2, 60, 61, 62, 63}) readings->Mutable(row)->set_group("g");
  if (backwards) std::reverse(readings->begin(), readings->end());
  for (int i = 0; i < readings->size(); ++i) readings->Mutable(i)->set_row(i);
  return input;
}

// Visits were compared with the first of their group alone and one pair was made of each group, so
// that the figures changed with the order of the rows and the others were gone without a word.
TEST(ReportFigures, RepeatabilityDoesNotDependOnTheOrderOfRows) {
  const v1::CalibrationReport forwards = MustRun(Visited(false)).report(),
                              backwards = MustRun(Visited(true)).report();
  for (const v1::CalibrationReport& report : {forwards, backwards}) {
    EXPECT_EQ(report.repeatability().pairs(), 7);
    EXPECT_EQ(report.repeatability().groups(), 2);
    // 0.1, 0.2, 0.4, 0.1, 0.3, 0.2 and 0.3 mm.
    EXPECT_NEAR(report.repeatability().difference_mean_mm(), 1.6 / 7, 1e-9);
    EXPECT_TRUE(std::any_of(report.warnings().begin(), report.warnings().end(),
                            [](const std::string& warning) {
                              return warning.find("1 of 7 readings left out") != std::string::npos;
                            }));
  }
  EXPECT_NEAR(forwards.repeatability().iso_rp_mm(), backwards.repeatability().iso_rp_mm(), 1e-9);
}

// A partial recalibration was stored with the covariance of what it found alone.
TEST(ReportFigures, APartialCalibrationIsAPriorForAll) {
  v1::CalibrationInput input = SampleInput(121);
  const v1::PriorCalibration stored = PriorOf(MustRun(input));
  input.mutable_options()->set_split("");
  auto* readings = input.mutable_sessions(0)->mutable_readings();
  while (readings->size() > 6) readings->RemoveLast();
  input.mutable_options()->set_calibrate("dq3");
  input.mutable_options()->set_prior("calibration");
  *input.mutable_options()->mutable_prior_calibration() = stored;
  const v1::Calibration part = MustRun(input);
  const v1::PriorCalibration next = PriorOf(part);
  EXPECT_EQ(next.identified_size(), stored.identified_size());
  EXPECT_EQ(next.covariance_size(), stored.covariance_size());
  EXPECT_EQ(part.report().parameters().identified(), 13) << "held ones are not identified";
  EXPECT_EQ(part.report().parameters().values(13).nominal(),
            part.report().parameters().values(13).identified());
  input.mutable_options()->set_calibrate("all");
  *input.mutable_options()->mutable_prior_calibration() = next;
  const v1::Calibration all = MustRun(input);
  for (const v1::ParameterValue& value : all.report().parameters().values())
    if (value.group() == v1::INTERNAL && value.unit() == "deg") {
      EXPECT_LT(value.sd(), 0.05) << value.name();
    }
}

}  // namespace
}  // namespace truepose::convert
