// Would catch a conversion that is right to first order only, frames put on the wrong side, effects
// lost, and a singular form that is taken all the same.
#include "core/conversion/convert_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/fault.h"
#include "tests/core/testing/models.h"

namespace truepose {
namespace {

using ::testing::HasSubstr;
using testing::kDeg;
using testing::ModelOf;
using testing::RandomVector;

Pose AnyPose(Random* random) {
  return {ExpRotation<double>(RandomVector(3, 2, random)), RandomVector(3, 2, random)};
}

// Errors of 0.5 mm and 0.5 mrad, two placements and two targets.
Estimate AnyCalibration(const Model& model, Random* random) {
  Estimate estimate;
  estimate.X_MB = {AnyPose(random), AnyPose(random)};
  estimate.X_FT = {AnyPose(random), AnyPose(random)};
  estimate.lambda.resize(model.parameters.size());
  for (double& value : estimate.lambda) value = 5e-4 * random->Normal();
  return estimate;
}

// Distance of the predictions of two calibrations, m and rad added, over joints of +-3 rad or m; a
// metre of frames beside it costs no more than rounding.
double Apart(const Model& a, const Estimate& x, const Model& b, const Estimate& y,
             const Conditions& conditions = {}) {
  Random random(101);
  double worst = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const Eigen::VectorXd q = RandomVector(JointCount(a.chain), 3, &random);
    for (size_t k = 0; k < x.X_MB.size(); ++k) {
      const Pose p = x.X_MB[k] * Forward(a, q, x.lambda, conditions) * x.X_FT[1 - k],
                 r = y.X_MB[k] * Forward(b, q, y.lambda, conditions) * y.X_FT[1 - k];
      worst =
          std::max({worst, (p.p - r.p).norm(), LogRotation<double>(p.R * r.R.transpose()).norm()});
    }
  }
  return worst;
}

class EveryRobot : public ::testing::TestWithParam<int> {
 protected:
  static testing::NamedRobot TheRobot() {
    const std::vector<testing::NamedRobot> robots = {
        {"UR10", testing::Ur10()},
        {"Panda", testing::Panda()},
        {"Stanford", testing::Stanford()},
        {"SCARA",
         testing::DhRobot({{0, .3, .25, 0}, {0, 0, .2, 0}, {0, .1, 0, 0}, {0, .05, 0, 0}}, "RRPR")},
        {"measuring arm", testing::MeasuringArm()},
        {"SCARA with coincident axes",
         testing::DhRobot({{0, .3, .25, 0}, {0, 0, .2, 0}, {0, .1, 0, 0}, {0, .05, 0, 0}}, "RRRP")},
        {"awkward axes", testing::AllRobots().at(13).robot}};
    return robots[GetParam()];
  }
};

// All twelve ordered pairs, and back: the prediction stays within 1e-9 m and rad (each has its own
// bound in the result; the frames' lever arm of 2 m adds a factor of 3 to what the flange sees).
TEST_P(EveryRobot, PredictionStays) {
  const testing::NamedRobot named = TheRobot();
  Random random(102);
  for (const std::string& kind : ModelKinds()) {
    const Model from = ModelOf(kind, named.robot, ModelExtent::kInternal);
    const Estimate calibration = AnyCalibration(from, &random);
    for (const std::string& other : ModelKinds()) {
      SCOPED_TRACE(named.name + ", " + kind + " to " + other);
      const Model to = ModelOf(other, named.robot, ModelExtent::kInternal);
      const auto there = ConvertCalibration(named.robot, from, calibration, to);
      ASSERT_TRUE(there.ok()) << there.status();
      EXPECT_LT(there->worst.position_m, 1e-9);
      EXPECT_LT(there->worst.rotation_rad, 1e-9);
      EXPECT_LT(Apart(from, calibration, to, there->estimate), 1e-9);
      const auto back = ConvertCalibration(named.robot, to, there->estimate, from);
      ASSERT_TRUE(back.ok()) << back.status();
      EXPECT_LT(Apart(from, calibration, from, back->estimate), 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Conversion, EveryRobot, ::testing::Range(0, 7));

// Only second order makes the frames' share of an incremental calibration differ from that of a
// Zhuang-Roth one: names apart, converting must do something.
TEST(ConvertCalibration, IsNotACopyOfValues) {
  const Robot robot = testing::Ur10();
  const Model from = ModelOf("incremental", robot, ModelExtent::kInternal),
              to = ModelOf("modified_incremental", robot, ModelExtent::kInternal);
  Random random(103);
  Estimate calibration = AnyCalibration(from, &random);
  calibration.lambda(*from.parameters.Find("dbeta1")) = 0.01;
  const auto converted = ConvertCalibration(robot, from, calibration, to);
  ASSERT_TRUE(converted.ok()) << converted.status();
  EXPECT_EQ(converted->estimate.lambda(*to.parameters.Find("dbeta1")), 0);
  EXPECT_GT((converted->estimate.X_MB[0].R - calibration.X_MB[0].R).norm(), 5e-3);
}

// Effects act on joints as read: gain, harmonics and temperature keep their values, also through a
// coupling of joints, and the prediction stays with them.
TEST(ConvertCalibration, EffectsKeepTheirValues) {
  JointMap map = JointMap::Identity(6);
  map.scale(2, 1) = 1;
  map.offset(3) = 0.4;
  const auto robot = Robot::Create(testing::Ur10().joints(), testing::Ur10().chain(), map);
  ASSERT_TRUE(robot.ok()) << robot.status();
  Model from = ModelOf("modified_incremental", *robot, ModelExtent::kInternal),
        to = ModelOf("extended_dh", *robot, ModelExtent::kInternal);
  for (EffectGroup group : {EffectGroup::kGain, EffectGroup::kHarmonic1, EffectGroup::kTemperature})
    AddEffects(*robot, group, &from);
  Random random(104);
  Estimate calibration = AnyCalibration(from, &random);
  const auto refused = ConvertCalibration(*robot, from, calibration, to);
  EXPECT_EQ(refused.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(FaultsOf(refused.status()).size(), 24u);
  for (EffectGroup group : {EffectGroup::kTemperature, EffectGroup::kGain, EffectGroup::kHarmonic1})
    AddEffects(*robot, group, &to);
  const auto converted = ConvertCalibration(*robot, from, calibration, to);
  ASSERT_TRUE(converted.ok()) << converted.status();
  EXPECT_EQ(converted->estimate.lambda(*to.parameters.Find("harmonic1_cos3")),
            calibration.lambda(*from.parameters.Find("harmonic1_cos3")));
  Conditions conditions;
  conditions.temperature_K = 7;
  EXPECT_LT(Apart(from, calibration, to, converted->estimate, conditions), 1e-9);
}

// D&H with its four parameters on links first to last, wherever the axes are; the offset alone on
// the others.
Model ForcedDh(const Robot& robot, int first, int last) {
  Model model;
  model.kind = "forced_dh";
  model.joint_map = robot.joint_map();
  model.chain = robot.chain();
  for (size_t k = 0; k < model.chain.size(); ++k) {
    const int link = static_cast<int>(k / 4) + 1, place = static_cast<int>(k % 4);
    if (place != 0 && (link < first || link > last)) continue;
    const char* const stems[] = {"dq", "dh", "dl", "dphi"};
    const bool angle = place == 0 || place == 3;
    model.chain[k].parameter =
        model.parameters.Add({stems[place] + std::to_string(link), ParameterGroup::kInternal,
                              place == 0 ? ParameterRole::kJointOffset
                              : angle    ? ParameterRole::kAngle
                                         : ParameterRole::kLength,
                              angle ? Unit::kRadian : Unit::kMetre});
  }
  return model;
}

std::string OnlyFault(const absl::Status& status) {
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition) << status;
  const std::vector<Fault> faults = FaultsOf(status);
  return faults.size() == 1 ? ToString(faults[0]) : "not one fault";
}

// Axes 2, 3 and 4 of the UR10 are parallel: D&H can't tilt one against the other. The joint that is
// named is the one whose axis is tilted.
TEST(ConvertCalibration, NamesTheSingularJoint) {
  const Robot robot = testing::Ur10();
  const Model from = ModelOf("modified_incremental", robot, ModelExtent::kInternal),
              to = ForcedDh(robot, 1, 5);
  for (int link : {2, 3}) {
    Estimate calibration = NominalEstimate(Problem{&from, {}, {""}, {""}});
    calibration.lambda(*from.parameters.Find("dbeta" + std::to_string(link))) = 5e-4;
    calibration.lambda(*from.parameters.Find("da4")) = 1e-3;
    const std::string fault = OnlyFault(ConvertCalibration(robot, from, calibration, to).status());
    EXPECT_THAT(fault, HasSubstr("joints[" + std::to_string(link - 1) + "]"));
    EXPECT_THAT(fault, HasSubstr("dbeta" + std::to_string(link) + " = 0.5 mrad"));
    EXPECT_THAT(fault, HasSubstr("j" + std::to_string(link)));
  }
}

// Without the tilt D&H expresses the rest.
TEST(ConvertCalibration, SingularFormServesWhatItCan) {
  const Robot robot = testing::Ur10();
  const Model from = ModelOf("modified_incremental", robot, ModelExtent::kInternal),
              to = ForcedDh(robot, 1, 5);
  Estimate calibration = NominalEstimate(Problem{&from, {}, {""}, {""}});
  calibration.lambda(*from.parameters.Find("da4")) = 1e-3;
  EXPECT_TRUE(ConvertCalibration(robot, from, calibration, to).ok());
}

// A milliradian from parallel D&H has the direction, but at the price of a length that runs away.
TEST(ConvertCalibration, NamesTheJointWhoseParametersRanAway) {
  const Robot robot = testing::DhRobot({{0, .1273, 0, 90 * kDeg},
                                        {0, 0, -.612, 1e-3},
                                        {0, 0, -.5723, 60 * kDeg},
                                        {0, .163941, 0, 90 * kDeg},
                                        {0, .1157, 0, -90 * kDeg},
                                        {0, .0922, 0, 0}},
                                       "RRRRRR");
  const Model from = ModelOf("extended_dh", robot, ModelExtent::kInternal),
              to = ForcedDh(robot, 1, 5);
  Estimate calibration = NominalEstimate(Problem{&from, {}, {""}, {""}});
  calibration.lambda(*from.parameters.Find("dbeta2")) = 5e-4;
  const std::string fault = OnlyFault(ConvertCalibration(robot, from, calibration, to).status());
  EXPECT_THAT(fault, HasSubstr("ran away"));
  EXPECT_THAT(fault, HasSubstr("joints[1]"));
}

TEST(ConvertCalibration, RefusesWhatIsNoCalibration) {
  const Robot robot = testing::Ur10();
  const Model from = ModelOf("modified_incremental", robot, ModelExtent::kInternal);
  Estimate calibration = NominalEstimate(Problem{&from, {}, {""}, {""}});
  calibration.lambda(2) = std::nan("");
  const auto not_finite = ConvertCalibration(robot, from, calibration, from);
  EXPECT_THAT(FaultsOf(not_finite.status()),
              ::testing::ElementsAre(::testing::Field(&Fault::expected, "a finite number")));
  calibration.lambda.conservativeResize(3);
  const auto refused = ConvertCalibration(robot, from, calibration,
                                          ModelOf("incremental", robot, ModelExtent::kInternal));
  EXPECT_EQ(refused.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(ConvertCalibration(testing::Panda(), from, calibration, from).status().code(),
            absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace truepose
