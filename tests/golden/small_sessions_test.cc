// Simulated sessions that are small or measured with less than a pose, through everything behind
// the files: what they determine is found to the noise, what they don't is named and stays as it
// is.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>

#include "convert/frames.h"
#include "convert/robot.h"
#include "core/base/random.h"
#include "core/models/model.h"
#include "formats/robot_file.h"
#include "tests/core/testing/robots.h"
#include "tests/golden/measured.h"

namespace truepose {
namespace {

using convert::ToProto;

constexpr double kNoise_m = 5e-5, kNoise_rad = 1e-4;

v1::Nominal Ur10Nominal() {
  const auto robot = formats::ReadRobotFile(TRUEPOSE_SOURCE_DIR "/deploy/examples/ur10.yaml");
  EXPECT_TRUE(robot.ok()) << robot.status();
  return robot->nominal;
}

// A robot with errors in every candidate, m and rad.
class SimulatedUr10 {
 public:
  explicit SimulatedUr10(uint64_t seed, double error_sd = 5e-4)
      : random(seed),
        nominal_(Ur10Nominal()),
        robot_(*convert::RobotFrom(nominal_)),
        model(ModifiedIncremental(robot_, ModelExtent::kInternal)) {
    *input.mutable_nominal() = nominal_;
    input.add_sessions();
    lambda.resize(model.parameters.size());
    for (double& value : lambda) value = error_sd * random.Normal();
    X_MB = {ExpRotation<double>(testing::RandomVector(3, 1.5, &random)),
            testing::RandomVector(3, 2, &random)};
  }

  // A row of measured joints, yet without what the instrument saw.
  v1::Reading* AddRow(const Eigen::VectorXd& q) {
    v1::Reading* row = input.mutable_sessions(0)->add_readings();
    row->set_row(input.sessions(0).readings_size() - 1);
    for (const double value : q) row->add_joints_measured(value);
    return row;
  }

  // Of the target, 60 mm beside the last axis.
  Pose Seen(const Eigen::VectorXd& q, const Conditions& conditions = {}) {
    const Pose X_FT{Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.05, -0.03, 0.109)};
    return X_MB * Forward(model, q, lambda, conditions) * X_FT;
  }

  Eigen::Vector3d Noise(double sd) {
    return {sd * random.Normal(), sd * random.Normal(), sd * random.Normal()};
  }

  void MeasurePose(const Eigen::VectorXd& q) {
    const Pose X_MT = Seen(q);
    v1::Reading* row = AddRow(q);
    *row->mutable_position_m() = ToProto(Eigen::Vector3d(X_MT.p + Noise(kNoise_m)));
    *row->mutable_orientation() =
        convert::QuaternionToProto(ExpRotation<double>(Noise(kNoise_rad)) * X_MT.R);
  }

  const Robot& robot() const { return robot_; }

  Random random;

 private:
  v1::Nominal nominal_;
  Robot robot_;

 public:
  Model model;
  Eigen::VectorXd lambda;
  Pose X_MB;
  v1::CalibrationInput input;
};

// Control RMS over what the noise of `values` measured values alone would make of it.
double TimesTheNoise(const v1::Calibration& calibration, double values) {
  return testing::ControlRms(calibration) / (1e3 * kNoise_m * std::sqrt(values));
}

// 60 control poses. 30 parameters of 180 values cost 8 to 9 % of the noise's RMS where the poses
// are spread alike, more for the worst of them: 1.3. Before calibration it is 20 times the noise.
TEST(SmallSessions, ThirtyPoses) {
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    SimulatedUr10 robot(seed);
    for (int i = 0; i < 90; ++i) robot.MeasurePose(testing::RandomVector(6, 1.5, &robot.random));
    robot.input.mutable_options()->set_split("first:30");
    const v1::Calibration calibration = testing::MustCalibrate(robot.input);
    EXPECT_EQ(calibration.report().parameters().identified(), 30);
    EXPECT_LT(TimesTheNoise(calibration, 3), 1.3) << "seed " << seed;
    EXPECT_EQ(calibration.report().verdict(), "apply") << testing::VerdictOf(calibration);
    RecordProperty("times_noise", std::to_string(TimesTheNoise(calibration, 3)));
  }
}

// 30 poses of three reflectors each, so 90 points that share their joints. Would catch reflectors
// that are taken for one, or poses that are counted thrice.
TEST(SmallSessions, ThreeReflectorsAPose) {
  SimulatedUr10 robot(11);
  for (int i = 0; i < 90; ++i) {
    const Eigen::VectorXd q = testing::RandomVector(6, 1.5, &robot.random);
    const Pose X_MT = robot.Seen(q);
    v1::Reading* row = robot.AddRow(q);
    for (int k = 0; k < 3; ++k) {
      v1::MeasuredPoint* point = row->add_points();
      point->set_target("p" + std::to_string(k + 1));
      const Eigen::Vector3d place = 0.12 * Eigen::Vector3d::Unit(k);
      *point->mutable_position_m() = ToProto(Eigen::Vector3d(X_MT * place + robot.Noise(kNoise_m)));
    }
  }
  robot.input.mutable_options()->set_split("first:30");
  const v1::Calibration calibration = testing::MustCalibrate(robot.input);
  // 27 of one point, three more for each further one.
  EXPECT_EQ(calibration.report().parameters().identified(), 33);
  EXPECT_LT(TimesTheNoise(calibration, 3), 1.3);
  EXPECT_EQ(calibration.report().verdict(), "apply") << testing::VerdictOf(calibration);
}

// Wires from four points that nobody measured, and joints that give way under gravity by torques
// that the controller reports: 2e-6 rad / (N m), up to 0.3 mm of a wire.
class DrawWires : public ::testing::Test {
 protected:
  DrawWires() : robot_(21) {
    const int geometric = robot_.model.parameters.size();
    AddEffects(robot_.robot(), EffectGroup::kCompliance, &robot_.model);
    robot_.lambda.conservativeResize(robot_.model.parameters.size());
    robot_.lambda.tail(robot_.model.parameters.size() - geometric).setConstant(2e-6);
    const Eigen::Vector3d anchors[] = {
        {1.2, 1.1, 0.1}, {1.3, -1.2, 0.3}, {-1.4, 1.0, 0.8}, {0.4, 0.3, 2.5}};
    for (int i = 0; i < 400; ++i) Measure(i % 4, robot_.X_MB * anchors[i % 4]);
    robot_.input.mutable_options()->set_split("first:240");
  }

  void Measure(int wire, const Eigen::Vector3d& anchor_M) {
    const Eigen::VectorXd q = testing::RandomVector(6, 1.5, &robot_.random);
    Conditions conditions;
    conditions.joint_torque = GravityLoad(robot_.robot().chain(), kMasses, q);
    v1::Reading* row = robot_.AddRow(q);
    for (const double torque : conditions.joint_torque) row->add_joint_torques_nm(torque);
    row->set_distance_m((robot_.Seen(q, conditions).p - anchor_M).norm() +
                        kNoise_m * robot_.random.Normal());
    row->set_anchor("wire " + std::to_string(wire));
  }

  // Upper arm, forearm and wrist, not told to the program.
  const std::vector<LinkMass> kMasses = {
      {1, 12.9, {-0.3, 0, 0.127}}, {2, 4.3, {-0.85, 0, 0.127}}, {5, 8, {-1.18, -0.25, 0.06}}};
  SimulatedUr10 robot_;
};

// Would catch unknown points that are taken for known ones, and torques that don't reach the
// joints.
TEST_F(DrawWires, WithJointTorques) {
  robot_.input.mutable_options()->set_effects("compliance");
  const v1::Calibration calibration = testing::MustCalibrate(robot_.input);
  EXPECT_LT(TimesTheNoise(calibration, 1), 1.3);
  // Gravity puts no torque on a vertical axis: its compliance stays at nominal and is named.
  std::set<std::string> undetermined;
  for (const v1::Redundancy& redundancy : calibration.report().redundancies()) {
    if (!redundancy.structural()) undetermined.insert(redundancy.dropped());
  }
  EXPECT_EQ(undetermined, std::set<std::string>{"compliance1"});
  EXPECT_EQ(calibration.report().verdict(), "apply_within_volume")
      << testing::VerdictOf(calibration);
}

// The torques are what it takes: geometry alone leaves more.
TEST_F(DrawWires, GeometryAloneLeavesCompliance) {
  EXPECT_GT(TimesTheNoise(testing::MustCalibrate(robot_.input), 1), 1.5);
}

std::set<std::string> IdentifiedNames(const v1::CalibrationReport& report) {
  std::set<std::string> names;
  for (const v1::ParameterValue& value : report.parameters().values()) names.insert(value.name());
  return names;
}

// Joints 2 and 5 move: 4 R + 6 = 14 parameters with R = 2, of which the frames are 12. Errors of
// 2 mm and 2 mrad, so that the two that are left are worth applying.
TEST(SmallSessions, TwoJointsMove) {
  SimulatedUr10 robot(31, 2e-3);
  for (int i = 0; i < 60; ++i) {
    Eigen::VectorXd q = Eigen::VectorXd::Constant(6, 0.7);
    q(1) = robot.random.Uniform(-1.5, 1.5);
    q(4) = robot.random.Uniform(-1.5, 1.5);
    robot.MeasurePose(q);
  }
  robot.input.mutable_options()->set_split("even-odd");
  const v1::Calibration calibration = testing::MustCalibrate(robot.input);
  const v1::CalibrationReport& report = calibration.report();
  const std::set<std::string> identified = IdentifiedNames(report);
  EXPECT_EQ(identified.size(), 14u);
  std::set<std::string> named;
  int by_these_readings = 0;
  for (const v1::Redundancy& redundancy : report.redundancies()) {
    EXPECT_FALSE(redundancy.reason().empty()) << redundancy.dropped();
    named.insert(redundancy.dropped());
    by_these_readings += !redundancy.structural();
  }
  EXPECT_EQ(by_these_readings, 30 - 14);
  for (const v1::InternalParameter& parameter : calibration.internal_parameters()) {
    EXPECT_NE(identified.contains(parameter.name()), named.contains(parameter.name()))
        << parameter.name();
    if (named.contains(parameter.name())) {
      EXPECT_EQ(parameter.value(), 0) << parameter.name();
    }
  }
  EXPECT_EQ(report.verdict(), "apply_within_volume") << testing::VerdictOf(calibration);
  EXPECT_LT(TimesTheNoise(calibration, 3), 1.3);
}

}  // namespace
}  // namespace truepose
