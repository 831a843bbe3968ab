// The compensation table of a measured UR10 (experiments E5): internal errors as identified on
// series C, scaled until the flange is off by 1.0 mm RMS over the volume with best-fit base and
// tool.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <iostream>

#include "compensation/encode_table.h"
#include "compensation/lookup.h"
#include "convert/calibrated_model.h"
#include "convert/robot.h"
#include "core/assessment/statistics.h"
#include "core/compensation/arm_from.h"
#include "core/compensation/build_table.h"
#include "core/compensation/pose_samples.h"
#include "core/compensation/table_error.h"
#include "core/identification/identify.h"
#include "tests/golden/measured.h"

namespace truepose {
namespace {

constexpr double kDeg = 0.017453292519943295;

// x .30-1.05, y +-.70, z 0-.95, tool down within 30 deg, elbow up.
TableSpec E5() {
  TableSpec spec;
  spec.box.emplace();
  spec.box->box_B = {Eigen::Vector3d(.30, -.70, 0), Eigen::Vector3d(1.05, .70, .95)};
  spec.box->cone_rad = 30 * kDeg;
  spec.box->reference = (Eigen::VectorXd(6) << 3.14, -1.2, 1.8, -2.17, -1.57, 0).finished();
  return spec;
}

class MeasuredUr10Table : public ::testing::Test {
 protected:
  void SetUp() override {
    const v1::CalibrationInput input = testing::Ur10Series("C");
    const v1::Calibration calibration = testing::MustCalibrate(input);
    auto robot = convert::RobotFrom(input.nominal());
    ASSERT_TRUE(robot.ok()) << robot.status();
    auto calibrated = convert::CalibratedModelFrom(*robot, calibration);
    ASSERT_TRUE(calibrated.ok()) << calibrated.status();
    const double rms = RmsOverVolume(*robot, *calibrated);
    calibrated->lambda *= 1e-3 / rms;
    std::cout << "as identified " << 1e3 * rms << " mm RMS over the volume; scaled to "
              << 1e3 * RmsOverVolume(*robot, *calibrated) << " mm\n";
    auto arm = ArmFrom(*robot, calibrated->model, calibrated->lambda);
    ASSERT_TRUE(arm.ok()) << arm.status();
    arm_ = *arm;
  }

  // Position of the flange, base and tool fitted to full poses that weigh 1 mm as 1 mrad.
  static double RmsOverVolume(const Robot& robot, const convert::CalibratedModel& calibrated) {
    const Eigen::VectorXd nominal = Eigen::VectorXd::Zero(calibrated.lambda.size());
    const auto arm = ArmFrom(robot, calibrated.model, nominal);
    EXPECT_TRUE(arm.ok()) << arm.status();
    Problem problem;
    problem.model = &calibrated.model;
    problem.placements = problem.targets = {""};
    for (const JointVector& q : SamplePoses(*arm, *E5().box, 500, 0, 5).q_chain) {
      Reading reading;
      reading.q = q;
      reading.kind = ObservationKind::kPose;
      reading.X_MT = Forward(calibrated.model, reading.q, calibrated.lambda);
      reading.id = static_cast<int>(problem.readings.size());
      problem.readings.push_back(reading);
    }
    IdentifyOptions options;
    options.known_model_error = ModelError{1e-3, 1e-3};
    const auto fitted = FitFrames(problem, {{Pose{}}, {Pose{}}, nominal}, options, {});
    EXPECT_TRUE(fitted.ok()) << fitted.status();
    return PoseStatisticsOf(PoseErrors(problem, fitted->estimate)).position_m.rms;
  }

  compensation::Arm arm_;
};

// Would catch any loss in the chain from the chosen coordinates to the reader's Newton step: E5
// found 0.59 MB enough. The targets are poses of the box, not points of the table's domain.
TEST_F(MeasuredUr10Table, CorrectsTenThousandPosesOfTheVolume) {
  const auto built = BuildTable(arm_, E5(), {}, {});
  ASSERT_TRUE(built.ok()) << built.status();
  const compensation::Table table = compensation::MakeTable(built->content);
  const PoseSamples targets = SamplePoses(arm_, *E5().box, 15000, 0, 1234);
  const TableAxes chain(arm_, JointMatrix::Identity(6, 6));
  int corrected = 0, near_singular = 0;
  compensation::PoseError worst;
  for (const JointVector& q_chain : targets.q_chain) {
    const JointVector q = chain.ToController(q_chain);
    const TablePoint point = TableErrorAt(table, arm_, q.data());
    near_singular += point.outcome == compensation::Outcome::kNearSingular;
    if (point.outcome == compensation::Outcome::kNearSingular) continue;
    ASSERT_EQ(point.outcome, compensation::Outcome::kOk) << q.transpose();
    ++corrected;
    worst.position_m = std::max(worst.position_m, point.error.position_m);
    worst.rotation_rad = std::max(worst.rotation_rad, point.error.rotation_rad);
  }
  const compensation::TableHeader& header = built->content.header;
  std::cout << "nodes";
  for (int n : built->estimate.nodes) std::cout << " " << n;
  std::cout << ", " << built->estimate.bytes / 1e6 << " MB; worst of " << corrected << " poses "
            << 1e3 * worst.position_m << " mm, " << worst.rotation_rad / kDeg << " deg; stated "
            << 1e3 * header.worst.position_m << " mm, " << header.worst.rotation_rad / kDeg
            << " deg; not reached " << targets.unreachable << ", near a singularity "
            << near_singular << "; of the domain " << 100 * header.near_singular_share << " %\n";
  EXPECT_GE(corrected, 10000);
  EXPECT_LE(worst.position_m, 2e-5);
  EXPECT_LE(worst.rotation_rad, 0.005 * kDeg);
  EXPECT_LE(worst.position_m, header.worst.position_m);
  EXPECT_LT(compensation::Encode(built->content).size(), 4'000'000u);
}

}  // namespace
}  // namespace truepose
