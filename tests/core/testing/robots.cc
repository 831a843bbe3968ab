#include "tests/core/testing/robots.h"

#include <cstdlib>
#include <iostream>

namespace truepose::testing {
namespace {

std::vector<JointType> TypesOf(const std::string& letters) {
  std::vector<JointType> types;
  for (char letter : letters)
    types.push_back(letter == 'R' ? JointType::kRevolute : JointType::kPrismatic);
  return types;
}

Robot RobotOf(const Chain& chain, const std::string& letters) {
  std::vector<Joint> joints;
  for (JointType type : TypesOf(letters))
    joints.push_back({"j" + std::to_string(joints.size() + 1), type});
  auto robot = Robot::Create(joints, chain, JointMap::Identity(static_cast<int>(joints.size())));
  if (!robot.ok()) {
    std::cerr << robot.status() << "\n";
    std::abort();
  }
  return *robot;
}

}  // namespace

Robot DhRobot(const std::vector<DhRow>& rows, const std::string& types) {
  return RobotOf(ChainFromStandardDh(rows, TypesOf(types)), types);
}

Robot Ur10() {
  return DhRobot({{0, .1273, 0, 90 * kDeg},
                  {0, 0, -.612, 0},
                  {0, 0, -.5723, 0},
                  {0, .163941, 0, 90 * kDeg},
                  {0, .1157, 0, -90 * kDeg},
                  {0, .0922, 0, 0}},
                 "RRRRRR");
}

Robot Panda() {
  Chain chain = ChainFromCraigDh({{0, .333, 0, 0},
                                  {0, 0, 0, -90 * kDeg},
                                  {0, .316, 0, 90 * kDeg},
                                  {0, 0, .0825, 90 * kDeg},
                                  {0, .384, -.0825, -90 * kDeg},
                                  {0, 0, 0, 90 * kDeg},
                                  {0, 0, .088, 90 * kDeg}},
                                 TypesOf("RRRRRRR"));
  chain.push_back(Translation(Axis::kZ, .107));
  return RobotOf(chain, "RRRRRRR");
}

Robot Stanford() {
  return DhRobot({{0, .412, 0, 90 * kDeg},
                  {0, .154, 0, 90 * kDeg},
                  {0, .4, 0, 0},
                  {0, 0, 0, -90 * kDeg},
                  {0, 0, 0, 90 * kDeg},
                  {0, .263, 0, 0}},
                 "RRPRRR");
}

Robot MeasuringArm() {
  return DhRobot({{0, .252, 0, 90 * kDeg},
                  {0, 0, .32, 0},
                  {90 * kDeg, 0, 0, 90 * kDeg},
                  {0, .33, 0, 90 * kDeg},
                  {-90 * kDeg, 0, 0, 90 * kDeg}},
                 "RRRRR");
}

std::vector<CountedRobot> CountedRobots() {
  const double r = 90 * kDeg;
  return {
      {"elbow 6R", Ur10(), 30},
      {"Stanford", Stanford(), 28},
      {"SCARA RRPR",
       DhRobot({{0, .3, .25, 0}, {0, 0, .2, 0}, {0, .1, 0, 0}, {0, .05, 0, 0}}, "RRPR"), 20},
      {"SCARA RRRP",
       DhRobot({{0, .3, .25, 0}, {0, 0, .2, 0}, {0, .1, 0, 0}, {0, .05, 0, 0}}, "RRRP"), 20},
      {"gantry PPP", DhRobot({{0, .1, 0, r}, {r, .2, 0, r}, {0, .3, 0, 0}}, "PPP"), 12},
      {"PPPRRR",
       DhRobot({{0, .1, 0, r},
                {r, .2, 0, r},
                {0, .3, 0, 0},
                {0, .1, 0, -r},
                {0, 0, 0, r},
                {0, .1, 0, 0}},
               "PPPRRR"),
       24},
      {"single R", DhRobot({{0, .1, .2, 0}}, "R"), 10},
      {"planar 3R", DhRobot({{0, 0, .3, 0}, {0, 0, .25, 0}, {0, 0, .1, 0}}, "RRR"), 18},
      {"Panda 7R", Panda(), 34},
      {"RPPRR",
       DhRobot({{0, .3, 0, r}, {0, .2, 0, r}, {0, .2, 0, r}, {0, .1, .1, r}, {0, .1, 0, 0}},
               "RPPRR"),
       22},
  };
}

Eigen::VectorXd RandomVector(int size, double range, Random* random) {
  Eigen::VectorXd v(size);
  for (Eigen::Index i = 0; i < size; ++i) v(i) = random->Uniform(-range, range);
  return v;
}

}  // namespace truepose::testing
