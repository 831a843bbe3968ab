#include "core/robot/robot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/fault.h"
#include "core/models/model.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using testing::kDeg;

// A standard D&H link by hand: theta = 90, d = 2, a = 3, alpha = 90, so x is carried to y and the
// end is at (0, 3, 2).
TEST(Dh, StandardLink) {
  const Chain chain = ChainFromStandardDh({{90 * kDeg, 2, 3, 90 * kDeg}}, {JointType::kRevolute});
  const double q = 0;
  const Pose X = Forward<double>(chain, &q, nullptr);
  EXPECT_LT((X.p - Eigen::Vector3d(0, 3, 2)).norm(), 1e-15);
  EXPECT_LT((X.R.col(2) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-15);
}

// Craig: alpha and a come first, so the joint turns about the tilted axis.
TEST(Dh, CraigLink) {
  const Chain chain = ChainFromCraigDh({{0, 2, 3, 90 * kDeg}}, {JointType::kRevolute});
  const double q = 90 * kDeg;
  const Pose X = Forward<double>(chain, &q, nullptr);
  EXPECT_LT((X.p - Eigen::Vector3d(3, -2, 0)).norm(), 1e-15);
  EXPECT_LT((X.R.col(0) - Eigen::Vector3d(0, 0, 1)).norm(), 1e-15);
}

TEST(Dh, PrismaticJointMovesD) {
  const Chain chain = ChainFromStandardDh({{0, 0.5, 0, 0}}, {JointType::kPrismatic});
  const double q = 0.25;
  EXPECT_LT((Forward<double>(chain, &q, nullptr).p - Eigen::Vector3d(0, 0, 0.75)).norm(), 1e-15);
}

// The UR10's zero pose, from its data sheet: stretched along -x, flange at y = -(163.941 + 92.2), z
// = 127.3 - 115.7.
TEST(Robot, Ur10AtZero) {
  const Pose X = NominalForward(testing::Ur10(), Eigen::VectorXd::Zero(6));
  EXPECT_LT((X.p - Eigen::Vector3d(-1.1843, -0.256141, 0.0116)).norm(), 1e-12);
}

TEST(Robot, JointMapGoesBothWays) {
  JointMap map{(Eigen::Matrix2d() << 1, 0, 1, -1).finished(), Eigen::Vector2d(0.1, -0.2)};
  const Eigen::Vector2d q(0.3, 0.5);
  EXPECT_LT((map.ToChain(q) - Eigen::Vector2d(0.4, -0.4)).norm(), 1e-15);
  EXPECT_LT((map.ToController(map.ToChain(q)) - q).norm(), 1e-15);
}

TEST(Robot, MiddleOfLimits) {
  std::vector<Joint> joints = {{"a", JointType::kRevolute, -1, 2}, {"b"}};
  const auto robot = Robot::Create(
      joints, ChainFromStandardDh({{}, {0, 0, 1, 0}}, {JointType::kRevolute, JointType::kRevolute}),
      JointMap::Identity(2));
  ASSERT_TRUE(robot.ok());
  EXPECT_EQ(robot->MiddleOfLimits(), Eigen::Vector2d(0.5, 0));
  joints = {{"a", JointType::kRevolute, 2}, {"b"}};
  const auto one_sided = Robot::Create(joints, robot->chain(), JointMap::Identity(2));
  ASSERT_TRUE(one_sided.ok());
  EXPECT_EQ(one_sided->MiddleOfLimits(), Eigen::Vector2d(2, 0));
}

std::vector<Fault> FaultsWith(std::vector<Joint> joints, const Chain& chain, const JointMap& map) {
  return FaultsOf(Robot::Create(std::move(joints), chain, map).status());
}

ElementaryTransform Moving(Motion motion, Axis axis, int joint) {
  return {motion, axis, 0, joint, -1};
}

// Each fault of Create, with its field; two in one robot come together.
TEST(RobotFaults, AllAtOnce) {
  const Chain chain = {Moving(Motion::kRotation, Axis::kZ, 1),
                       Moving(Motion::kTranslation, Axis::kX, 0)};
  const auto faults =
      FaultsWith({{"a", JointType::kRevolute, 2, 1}, {"b"}}, chain, JointMap::Identity(2));
  ASSERT_EQ(faults.size(), 4u);
  EXPECT_EQ(faults[0].field, "joints[0].lower");
  EXPECT_EQ(faults[1].field, "geometry.chain.elements[0]");
  EXPECT_EQ(faults[2].field, "geometry.chain.elements[1]");
}

TEST(RobotFaults, JointCount) {
  const auto faults =
      FaultsWith({{"a"}, {"b"}}, {Moving(Motion::kRotation, Axis::kZ, 0)}, JointMap::Identity(2));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].field, "geometry");
}

// Would catch a look at the joint behind the last one: here it lies in memory that held a prismatic
// joint, which would be a second fault.
TEST(RobotFaults, AMotionOfAJointBehindTheLast) {
  std::vector<Joint> joints = {{"a"}, {"b", JointType::kPrismatic}};
  joints.pop_back();
  const Chain chain = {Moving(Motion::kRotation, Axis::kZ, 0),
                       Moving(Motion::kRotation, Axis::kX, 1)};
  const auto faults =
      FaultsOf(Robot::Create(std::move(joints), chain, JointMap::Identity(1)).status());
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].field, "geometry");
}

TEST(RobotFaults, WrongKindOfMotion) {
  const auto faults = FaultsWith({{"a", JointType::kPrismatic}},
                                 {Moving(Motion::kRotation, Axis::kZ, 0)}, JointMap::Identity(1));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].found, "a rotation");
}

TEST(RobotFaults, NotFinite) {
  Chain chain = {Moving(Motion::kRotation, Axis::kZ, 0)};
  chain[0].constant = NAN;
  EXPECT_EQ(FaultsWith({{"a"}}, chain, JointMap::Identity(1)).size(), 1u);
  EXPECT_EQ(FaultsWith({{"a", JointType::kRevolute, NAN, 1}},
                       {Moving(Motion::kRotation, Axis::kZ, 0)}, JointMap::Identity(1))
                .size(),
            1u);
}

TEST(RobotFaults, JointMap) {
  const Chain chain = {Moving(Motion::kRotation, Axis::kZ, 0)};
  EXPECT_EQ(FaultsWith({{"a"}}, chain, JointMap::Identity(2)).size(), 2u);
  EXPECT_EQ(
      FaultsWith({{"a"}}, chain, {Eigen::MatrixXd::Zero(1, 1), Eigen::VectorXd::Zero(1)}).size(),
      1u);
}

// Two parallel prismatic joints one after the other are one joint twice (chapter-notes 7); across a
// right angle, or with a revolute joint between them, they are fine.
TEST(RobotFaults, ParallelPrismatic) {
  const std::vector<Joint> two = {{"a", JointType::kPrismatic}, {"b", JointType::kPrismatic}};
  const Chain parallel = {Moving(Motion::kTranslation, Axis::kZ, 0), Translation(Axis::kX, 0.3),
                          Moving(Motion::kTranslation, Axis::kZ, 1)};
  const auto faults = FaultsWith(two, parallel, JointMap::Identity(2));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].field, "joints[1]");
  Chain opposite = parallel;
  opposite.insert(opposite.begin() + 1, Rotation(Axis::kX, 180 * kDeg));
  EXPECT_EQ(FaultsWith(two, opposite, JointMap::Identity(2)).size(), 1u);
  Chain square = parallel;
  square[2].axis = Axis::kX;
  EXPECT_TRUE(Robot::Create(two, square, JointMap::Identity(2)).ok());
}

// The nominal is rewritten so that each A_i begins with its joint motion: at zero parameters every
// pose is as before, also for joints about x and y.
TEST(ModifiedIncremental, ZeroParametersAreTheNominal) {
  Random random(51);
  const Chain chain = {Translation(Axis::kZ, 0.3),
                       Moving(Motion::kRotation, Axis::kX, 0),
                       Translation(Axis::kY, 0.4),
                       Moving(Motion::kRotation, Axis::kY, 1),
                       Moving(Motion::kTranslation, Axis::kX, 2),
                       Rotation(Axis::kZ, 0.2)};
  const auto robot =
      Robot::Create({{"a"}, {"b"}, {"c", JointType::kPrismatic}}, chain, JointMap::Identity(3));
  ASSERT_TRUE(robot.ok()) << robot.status();
  for (ModelExtent extent : {ModelExtent::kInternal, ModelExtent::kComplete}) {
    const Model model = ModifiedIncremental(*robot, extent);
    for (int draw = 0; draw < 10; ++draw) {
      const Eigen::VectorXd q = testing::RandomVector(3, 1, &random);
      const Pose a = NominalForward(*robot, q),
                 b = Forward(model.chain, q, Eigen::VectorXd::Zero(model.parameters.size()));
      EXPECT_LT((a.p - b.p).norm() + (a.R - b.R).norm(), 1e-14);
    }
  }
}

// An offset is the joint's own: dq_i does exactly what the reading does.
TEST(ModifiedIncremental, OffsetEqualsJointMotion) {
  Random random(52);
  const Model model = ModifiedIncremental(testing::Stanford(), ModelExtent::kInternal);
  const Eigen::VectorXd q = testing::RandomVector(6, 1, &random);
  for (int i = 0; i < 6; ++i) {
    Eigen::VectorXd lambda = Eigen::VectorXd::Zero(model.parameters.size()), moved = q;
    lambda(*model.parameters.Find("dq" + std::to_string(i + 1))) = 0.01;
    moved(i) += 0.01;
    const Pose a = Forward(model.chain, q, lambda),
               b = Forward(model.chain, moved, Eigen::VectorXd::Zero(lambda.size()));
    EXPECT_LT((a.p - b.p).norm() + (a.R - b.R).norm(), 1e-15);
  }
}

// The order inside B_i is Eq. 22's: rotations first. The other order agrees to first order only, so
// sets would not be exchangeable; this fixes it.
TEST(ModifiedIncremental, RotationsBeforeLengths) {
  const Model model = ModifiedIncremental(testing::DhRobot({{0, 0, 0, 0}, {0, 0, 0, 0}}, "RR"),
                                          ModelExtent::kInternal);
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(model.parameters.size());
  lambda(*model.parameters.Find("dbeta1")) = 90 * kDeg;
  lambda(*model.parameters.Find("da1")) = 0.5;
  EXPECT_LT((Forward(model.chain, Eigen::VectorXd::Zero(2), lambda).p - Eigen::Vector3d(0, 0, -0.5))
                .norm(),
            1e-15);
}

// Joint i+1 decides about the lengths of B_i (chapter-notes 1).
TEST(ModifiedIncremental, NoLengthsBeforeAPrismaticJoint) {
  const Model model = ModifiedIncremental(testing::Stanford(), ModelExtent::kInternal);
  EXPECT_FALSE(model.parameters.Find("da2").has_value());
  EXPECT_TRUE(model.parameters.Find("da3").has_value());
  EXPECT_TRUE(model.parameters.Find("dalpha2").has_value());
}

}  // namespace
}  // namespace truepose
