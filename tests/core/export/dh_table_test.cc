// D&H rows of axes: tables come back as they were given, and every table moves as its model does.
#include "core/export/dh_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using testing::CountedRobot;
using testing::kDeg;
using testing::RandomVector;

Home NominalHome(const Robot& robot) {
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  return *HomeOf(robot, model, Eigen::VectorXd::Zero(model.parameters.size()), JointSense::kChain);
}

Chain ChainOf(const DhTable& table, const Robot& robot) {
  std::vector<JointType> types;
  for (const Joint& joint : robot.joints()) types.push_back(joint.type);
  Chain chain = ChainFromStandardDh({table.base}, {JointType::kRevolute});
  chain[0].joint = -1;
  for (const ElementaryTransform& element : ChainFromStandardDh(table.rows, types))
    chain.push_back(element);
  chain.push_back(Rotation(Axis::kZ, table.flange_theta));
  chain.push_back(Translation(Axis::kZ, table.flange_d));
  return chain;
}

double LargestLength(const DhTable& table) {
  double largest = 1;
  for (const DhRow& row : table.rows) largest = std::max(largest, std::abs(row.d));
  return largest;
}

void ExpectMovesAlike(const DhTable& table, const Robot& robot, const Model& model,
                      const Eigen::VectorXd& lambda, Random* random, double tolerance) {
  const Chain chain = ChainOf(table, robot);
  for (int i = 0; i < 30; ++i) {
    const Eigen::VectorXd q = RandomVector(robot.joint_count(), 3, random);
    const Pose a = Forward<double>(chain, q.data(), nullptr), b = Forward(model, q, lambda);
    EXPECT_LT((a.p - b.p).norm(), tolerance);
    EXPECT_LT((a.R - b.R).norm(), tolerance);
  }
}

void ExpectRows(const DhTable& table, const std::vector<DhRow>& rows) {
  ASSERT_EQ(table.rows.size(), rows.size());
  for (size_t i = 0; i < rows.size(); ++i) {
    SCOPED_TRACE(i + 1);
    // Rounding: data sheets in m and quarter turns.
    EXPECT_NEAR(table.rows[i].theta, rows[i].theta, 1e-14);
    EXPECT_NEAR(table.rows[i].d, rows[i].d, 1e-14);
    EXPECT_NEAR(table.rows[i].a, rows[i].a, 1e-14);
    EXPECT_NEAR(table.rows[i].alpha, rows[i].alpha, 1e-14);
  }
  EXPECT_EQ(table.base.theta, 0);
  EXPECT_EQ(table.base.alpha, 0);
  EXPECT_NEAR(table.flange_theta, 0, 1e-14);
  EXPECT_NEAR(table.flange_d, 0, 1e-14);
}

// Would catch a normal turned round, d and a exchanged, parallel and coincident axes that get
// other rows than every data sheet gives them, a prismatic axis put beside the wrist.
TEST(DhTable, DataSheetsComeBack) {
  const double r = 90 * kDeg;
  ExpectRows(DhTableOf(NominalHome(testing::Ur10())), {{0, .1273, 0, r},
                                                       {0, 0, -.612, 0},
                                                       {0, 0, -.5723, 0},
                                                       {0, .163941, 0, r},
                                                       {0, .1157, 0, -r},
                                                       {0, .0922, 0, 0}});
  ExpectRows(DhTableOf(NominalHome(testing::DhRobot({{0, .412, 0, r},
                                                     {0, .154, 0, r},
                                                     {0, 0, 0, 0},
                                                     {0, 0, 0, -r},
                                                     {0, 0, 0, r},
                                                     {0, .263, 0, 0}},
                                                    "RRPRRR"))),
             {{0, .412, 0, r},
              {0, .154, 0, r},
              {0, 0, 0, 0},
              {0, 0, 0, -r},
              {0, 0, 0, r},
              {0, .263, 0, 0}});
  ExpectRows(DhTableOf(NominalHome(testing::DhRobot(
                 {{0, .252, 0, r}, {0, 0, .32, 0}, {r, 0, 0, r}, {0, .33, 0, r}, {-r, 0, 0, r}},
                 "RRRRR"))),
             {{0, .252, 0, r}, {0, 0, .32, 0}, {r, 0, 0, r}, {0, .33, 0, r}, {-r, 0, 0, r}});
}

// All chains with errors before joint 1 and behind the last joint as well: would catch a base row
// or a flange that takes up only part of what it has to.
TEST(DhTable, IdentifiedRobotsMoveAsTheirModels) {
  Random random(8);
  for (const CountedRobot& counted : testing::CountedRobots()) {
    for (const ModelExtent extent : {ModelExtent::kInternal, ModelExtent::kComplete}) {
      SCOPED_TRACE(counted.name);
      const Model model = ModifiedIncremental(counted.robot, extent);
      const Eigen::VectorXd lambda = RandomVector(model.parameters.size(), 2e-3, &random);
      const DhTable table = DhTableOf(*HomeOf(counted.robot, model, lambda, JointSense::kChain));
      // 1e-15 of the largest length: distant normals cost digits.
      ExpectMovesAlike(table, counted.robot, model, lambda, &random,
                       1e-13 + 3e-15 * LargestLength(table));
    }
  }
}

// Antiparallel axes and a flange turned by half a turn: would catch a sign of cos(alpha).
TEST(DhTable, AntiparallelAxes) {
  Random random(9);
  const Robot robot = testing::DhRobot(
      {{.2, .1, .3, 180 * kDeg}, {.4, .2, .25, 180 * kDeg}, {.1, .3, 0, 180 * kDeg}}, "RRR");
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.parameters.size());
  const DhTable table = DhTableOf(NominalHome(robot));
  EXPECT_NEAR(table.flange_theta, 0, 1e-14);
  EXPECT_NEAR(table.flange_d, 0, 1e-14);
  ExpectMovesAlike(table, robot, model, zero, &random, 1e-14);
}

// The size of d of nearly parallel axes is a fact of standard D&H (Sec. 5), not of rounding: with
// the angle e between axes 2 and 3 it is about 0.612 m / e for the angle's part across the link.
TEST(DhTable, NearlyParallelAxesAreFarAndStillExact) {
  Random random(10);
  const Robot robot = testing::Ur10();
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(model.parameters.size());
  lambda(*model.parameters.Find("dalpha2")) = 1e-4;
  const DhTable table = DhTableOf(*HomeOf(robot, model, lambda, JointSense::kChain));
  EXPECT_NEAR(std::abs(table.rows[1].alpha), 1e-4, 1e-12);
  lambda(*model.parameters.Find("dbeta2")) = 1e-4;
  const DhTable far = DhTableOf(*HomeOf(robot, model, lambda, JointSense::kChain));
  EXPECT_NEAR(std::abs(far.rows[1].d), .612 / 2e-4, 1);
  ExpectMovesAlike(far, robot, model, lambda, &random, 3e-11);
}

}  // namespace
}  // namespace truepose
