#include "tests/compensation/wrist_arms.h"

#include <Eigen/Geometry>
#include <numbers>

#include "tests/compensation/arms.h"

namespace truepose::testing {
namespace {

using compensation::Arm;

constexpr double kPi = std::numbers::pi;

Pose AlongZ(double length) { return {Eigen::Matrix3d::Identity(), {0, 0, length}}; }

Eigen::Matrix3d Turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

Pose RandomPose(Random* random) {
  const Eigen::Vector3d p = RandomVector(3, 1, random), u = RandomVector(3, 1, random);
  return {Turn(random->Uniform(-kPi, kPi), u.normalized()),
          random->Uniform(0.2, 0.5) * p.normalized()};
}

// The next axis at 0.6 to 2.5 rad to the last.
Pose RandomBend(Random* random) {
  const double before = random->Uniform(-kPi, kPi), behind = random->Uniform(-kPi, kPi);
  const double angle = random->Uniform(0.6, 2.5);
  return {Turn(before, Eigen::Vector3d::UnitZ()) * Turn(angle, Eigen::Vector3d::UnitX()) *
              Turn(behind, Eigen::Vector3d::UnitZ()),
          Eigen::Vector3d::Zero()};
}

}  // namespace

Arm NominalArm(const Robot& robot) { return WithErrors("", robot, 0, 1).arm; }

Arm DhWristArm(std::vector<DhRow> rows, const std::string& types, double wrist_angle) {
  rows.push_back({0, .43, 0, wrist_angle});
  rows.push_back({0, 0, 0, -wrist_angle});
  rows.push_back({0, .1, 0, 0});
  return NominalArm(DhRobot(rows, types + "RRR"));
}

std::vector<DhRow> PumaRows() {
  return {{0, .67, 0, 90 * kDeg}, {0, .15, .43, 0}, {0, 0, .02, -90 * kDeg}};
}

Arm RandomWristArm(const std::string& types, Random* random) {
  Arm arm;
  arm.nominal.joints = 6;
  for (size_t i = 0; i < 3; ++i) arm.nominal.prismatic[i] = types[i] == 'P';
  for (size_t i = 0; i < 7; ++i) arm.nominal.constant[i] = RandomPose(random);
  const double height_4 = random->Uniform(-0.3, 0.3), height_5 = random->Uniform(-0.3, 0.3);
  const double height_6 = random->Uniform(-0.3, 0.3);
  arm.nominal.constant[4] = AlongZ(height_4) * RandomBend(random) * AlongZ(height_5);
  arm.nominal.constant[5] = AlongZ(-height_5) * RandomBend(random) * AlongZ(height_6);
  arm.identified = arm.nominal;
  return arm;
}

std::vector<std::string> AllTypesOfThree() {
  return {"RRR", "RRP", "RPR", "RPP", "PRR", "PRP", "PPR", "PPP"};
}

}  // namespace truepose::testing
