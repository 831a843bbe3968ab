// The four models as matrices. Would catch a joint motion about the wrong axis, a frame of the D&H
// family that is not on its axis, a tilt that is no rotation, and a builder that is not listed.
#include "core/models/build_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/fault.h"
#include "core/models/dh_link.h"
#include "tests/core/testing/models.h"

namespace truepose {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::kDeg;
using testing::ModelOf;
using testing::RandomVector;

double Distance(const Pose& a, const Pose& b) { return (a.p - b.p).norm() + (a.R - b.R).norm(); }

std::vector<std::string> NamesOf(const Model& model) {
  std::vector<std::string> names;
  for (const Parameter& parameter : model.parameters) names.push_back(parameter.name);
  return names;
}

TEST(BuildModel, UnknownKindListsAll) {
  const auto model = BuildModel("dh", testing::Ur10(), ModelExtent::kInternal);
  ASSERT_EQ(model.status().code(), absl::StatusCode::kInvalidArgument);
  const std::vector<Fault> faults = FaultsOf(model.status());
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].field, "options.model");
  EXPECT_EQ(faults[0].found, "'dh'");
  for (const std::string& kind : ModelKinds()) EXPECT_THAT(faults[0].expected, HasSubstr(kind));
  EXPECT_EQ(ModelKinds().size(), 4u);
}

// A solver with no parameter at all would end the process.
TEST(BuildModel, NothingBetweenBaseAndFlange) {
  const Robot robot = testing::DhRobot({{0, .1, .2, 0}}, "R");
  for (const std::string kind : {"incremental", "zhuang_roth"}) {
    EXPECT_THAT(FaultsOf(BuildModel(kind, robot, ModelExtent::kInternal).status()),
                ElementsAre(::testing::Field(&Fault::field, "options.model")));
    EXPECT_TRUE(BuildModel(kind, robot, ModelExtent::kComplete).ok());
  }
  EXPECT_TRUE(BuildModel("extended_dh", robot, ModelExtent::kInternal).ok());
}

// At zero parameters every model is the robot: 1e-12 of lengths of a metre, over about 50 elements
// with constants that are rounded once.
TEST(BuildModel, NominalIsTheRobot) {
  Random random(81);
  for (const testing::NamedRobot& named : testing::AllRobots()) {
    for (const std::string& kind : ModelKinds()) {
      SCOPED_TRACE(named.name + ", " + kind);
      const Model model = ModelOf(kind, named.robot, ModelExtent::kComplete);
      EXPECT_EQ(model.kind, kind);
      EXPECT_EQ(model.convention.substr(0, kind.size() + 1), kind + "/");
      const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.parameters.size());
      for (int draw = 0; draw < 20; ++draw) {
        const Eigen::VectorXd q = RandomVector(named.robot.joint_count(), 3, &random);
        EXPECT_LT(Distance(Forward(model, q, zero), NominalForward(named.robot, q)), 1e-12);
      }
    }
  }
}

// The internal extent is the complete one with the external frames' parameters at zero: a value
// means the same in both.
TEST(BuildModel, InternalIsPartOfComplete) {
  Random random(82);
  for (const testing::NamedRobot& named : testing::AllRobots()) {
    for (const std::string& kind : ModelKinds()) {
      const auto internal = BuildModel(kind, named.robot, ModelExtent::kInternal);
      if (!internal.ok()) continue;
      SCOPED_TRACE(named.name + ", " + kind);
      const Model complete = ModelOf(kind, named.robot, ModelExtent::kComplete);
      const Eigen::VectorXd lambda = RandomVector(internal->parameters.size(), 0.1, &random),
                            q = RandomVector(named.robot.joint_count(), 2, &random);
      Eigen::VectorXd same = Eigen::VectorXd::Zero(complete.parameters.size());
      for (int i = 0; i < internal->parameters.size(); ++i)
        same(complete.parameters.Find(internal->parameters[i].name).value()) = lambda(i);
      EXPECT_LT(Distance(Forward(*internal, q, lambda), Forward(complete, q, same)), 1e-13);
    }
  }
}

// Eq. 23 as it is printed, B_1 of a robot of two joints.
Pose Eq23(double x, double y, double a, double b) {
  const double z = std::sqrt(1 - x * x - y * y);
  Pose B;
  B.R << 1 - x * x / (1 + z), -x * y / (1 + z), x,  //
      -x * y / (1 + z), 1 - y * y / (1 + z), y,     //
      -x, -y, z;
  B.p << a, b, 0;
  return B;
}

Eigen::VectorXd Values(const Model& model, const std::vector<std::pair<std::string, double>>& set) {
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(model.parameters.size());
  for (const auto& [name, value] : set) lambda(model.parameters.Find(name).value()) = value;
  return lambda;
}

// Literally, and proper; 1e-15 is four roundings of entries of size 1.
TEST(ZhuangRoth, IsEq23) {
  const Model model =
      ModelOf("zhuang_roth", testing::DhRobot({{}, {}}, "RR"), ModelExtent::kInternal);
  EXPECT_THAT(NamesOf(model), ElementsAre("da1", "db1", "dthetax1", "dthetay1"));
  Random random(83);
  for (double size : {0.0, 1e-9, 1e-3, 0.1, 0.6}) {
    for (int draw = 0; draw < 20; ++draw) {
      const Eigen::VectorXd v = RandomVector(4, size, &random);
      const Eigen::VectorXd lambda =
          Values(model, {{"dthetax1", v(0)}, {"dthetay1", v(1)}, {"da1", v(2)}, {"db1", v(3)}});
      const Pose B = Forward(model, Eigen::VectorXd::Zero(2), lambda);
      const Pose expected = Eq23(v(0), v(1), v(2), v(3));
      EXPECT_LT((B.R - expected.R).cwiseAbs().maxCoeff(), 1e-15);
      EXPECT_LT((B.p - expected.p).cwiseAbs().maxCoeff(), 1e-15);
      EXPECT_LT((B.R.transpose() * B.R - Eigen::Matrix3d::Identity()).norm(), 4e-15);
      EXPECT_GT(B.R.determinant(), 0);
    }
  }
}

// To first order dthetax = dbeta and dthetay = -dalpha: the rest is of second order, s^2 and less.
TEST(ZhuangRoth, FirstOrderIsEq22) {
  const Robot robot = testing::Ur10();
  const Model tilted = ModelOf("zhuang_roth", robot, ModelExtent::kComplete),
              turned = ModelOf("incremental", robot, ModelExtent::kComplete);
  ASSERT_EQ(tilted.parameters.size(), turned.parameters.size());
  Random random(84);
  const Eigen::VectorXd q = RandomVector(6, 2, &random), unit = RandomVector(30, 1, &random);
  for (double s : {1e-2, 1e-3, 1e-4}) {
    const Eigen::VectorXd lambda = s * unit;
    Eigen::VectorXd same = lambda;
    for (int i = 0; i < 6; ++i) {
      const std::string n = std::to_string(i);
      same(*tilted.parameters.Find("dthetax" + n)) = lambda(*turned.parameters.Find("dbeta" + n));
      same(*tilted.parameters.Find("dthetay" + n)) = -lambda(*turned.parameters.Find("dalpha" + n));
      same(*tilted.parameters.Find("da" + n)) = lambda(*turned.parameters.Find("da" + n));
      same(*tilted.parameters.Find("db" + n)) = lambda(*turned.parameters.Find("db" + n));
    }
    const double apart = Distance(Forward(tilted, q, same), Forward(turned, q, lambda));
    EXPECT_LT(apart, 20 * s * s);
    EXPECT_GT(apart, 1e-3 * s * s) << "the two forms are not the same to second order";
  }
}

// Eq. 22's order, rotations first, holds for the incremental model, too, and it has no offsets.
TEST(Incremental, RotationsFirstAndNoOffsets) {
  const Model model =
      ModelOf("incremental", testing::DhRobot({{}, {}}, "RR"), ModelExtent::kInternal);
  EXPECT_THAT(NamesOf(model), ElementsAre("dalpha1", "dbeta1", "da1", "db1"));
  const Pose B = Forward(model, Eigen::VectorXd::Zero(2),
                         Values(model, {{"dbeta1", 90 * kDeg}, {"da1", 0.5}}));
  EXPECT_LT((B.p - Eigen::Vector3d(0, 0, -0.5)).norm(), 1e-15);
}

// Every frame of an extended D&H link stands on the axis it is for, z along it.
TEST(ExtendedDh, FramesStandOnTheAxes) {
  for (const testing::NamedRobot& named : testing::AllRobots()) {
    SCOPED_TRACE(named.name);
    const std::vector<AxisLine> lines = WithPrismaticPlaced(named.robot, AxisLines(named.robot));
    Pose X;
    for (size_t i = 0; i < lines.size(); ++i) {
      const JointType moved = i == 0 ? JointType::kRevolute : named.robot.joints()[i - 1].type;
      const LinkStart start = i == 0                          ? LinkStart::kBase
                              : moved == JointType::kRevolute ? LinkStart::kRevolute
                                                              : LinkStart::kPrismatic;
      X = After(X, LinkTo(X, start, lines[i]));
      EXPECT_LT((X.R.col(2) - lines[i].u).norm(), 1e-14) << "axis " << i + 1;
      EXPECT_LT((X.p - lines[i].p).cross(lines[i].u).norm(), 1e-14) << "axis " << i + 1;
    }
  }
}

// The rules of Eq. 18 and of Table 3 by the names that they give.
TEST(ExtendedDh, FormsOfLinks) {
  EXPECT_THAT(
      NamesOf(ModelOf("extended_dh", testing::StanfordBesideBase(), ModelExtent::kComplete)),
      ElementsAre("dtheta0", "dl0", "dphi0", "dbeta0",               // Hayati
                  "dq1", "dh1", "dl1", "dphi1",                      // D&H
                  "dq2", "dh2", "dl2", "dphi2",                      // D&H
                  "dq3", "dh3", "dphi3", "dbeta3",                   // PR
                  "dq4", "dh4", "dl4", "dphi4",                      // D&H
                  "dq5", "dh5", "dl5", "dphi5",                      // D&H
                  "dq6", "dbeta6", "dalpha6", "dc6", "db6", "da6"))  // R6
  ;
  EXPECT_THAT(NamesOf(ModelOf("extended_dh", testing::Ur10(), ModelExtent::kInternal)),
              ElementsAre("dq1", "dh1", "dl1", "dphi1",     // D&H
                          "dq2", "dl2", "dphi2", "dbeta2",  // Hayati
                          "dq3", "dl3", "dphi3", "dbeta3",  // Hayati
                          "dq4", "dh4", "dl4", "dphi4",     // D&H
                          "dq5", "dh5", "dl5", "dphi5",     // D&H
                          "dq6"));
  const Robot scara =
      testing::DhRobot({{0, .3, .25, 0}, {0, 0, .2, 0}, {0, .1, 0, 0}, {0, .05, 0, 0}}, "RRRP");
  EXPECT_THAT(NamesOf(ModelOf("extended_dh", scara, ModelExtent::kComplete)),
              ElementsAre("da0", "db0", "dalpha0", "dbeta0",                      // Eq. 33
                          "dq1", "dl1", "dphi1", "dbeta1",                        // Hayati
                          "dq2", "dl2", "dphi2", "dbeta2",                        // Hayati
                          "dq3", "da3", "db3", "dalpha3", "dbeta3",               // coincident
                          "dq4", "db4", "da4", "dgamma4", "dbeta4", "dalpha4"));  // P6
}

// dq_i is the error of the joint's coordinate, wherever the form has it (Eq. 20).
TEST(ExtendedDh, OffsetEqualsJointMotion) {
  Random random(85);
  for (const testing::NamedRobot& named : testing::AllRobots()) {
    SCOPED_TRACE(named.name);
    const Model model = ModelOf("extended_dh", named.robot, ModelExtent::kInternal);
    const Eigen::VectorXd q = RandomVector(named.robot.joint_count(), 1, &random);
    for (int i = 0; i < named.robot.joint_count(); ++i) {
      Eigen::VectorXd moved = q;
      moved(i) += 0.01;
      EXPECT_LT(Distance(Forward(model, q, Values(model, {{"dq" + std::to_string(i + 1), 0.01}})),
                         NominalForward(named.robot, moved)),
                1e-12);
    }
  }
}

// l is the distance of the axes and h the way between the common normals: the UR10's data sheet,
// with a_2 = -0.612 as a length.
TEST(ExtendedDh, NominalValuesOfTheUr10) {
  const Robot robot = testing::Ur10();
  const std::vector<AxisLine> lines = WithPrismaticPlaced(robot, AxisLines(robot));
  Pose X;
  std::vector<Link> links;
  for (size_t i = 0; i < lines.size(); ++i) {
    links.push_back(LinkTo(X, i == 0 ? LinkStart::kBase : LinkStart::kRevolute, lines[i]));
    X = After(X, links.back());
  }
  EXPECT_NEAR(links[1][1].value, 0.1273, 1e-12);              // h_1
  EXPECT_NEAR(links[2][1].value, 0.612, 1e-12);               // l_2
  EXPECT_NEAR(links[3][1].value, 0.5723, 1e-12);              // l_3
  EXPECT_NEAR(std::abs(links[4][1].value), 0.163941, 1e-12);  // h_4
  EXPECT_NEAR(std::abs(links[5][1].value), 0.1157, 1e-12);    // h_5
}

// x points from axis to axis, so a table's negative a is a positive l, with theta turned by 180
// deg.
TEST(ExtendedDh, LengthsAreDistances) {
  const Robot robot = testing::DhRobot({{0, .1, -.2, 90 * kDeg}, {}}, "RR");
  const std::vector<AxisLine> lines = AxisLines(robot);
  const Link link = LinkTo({}, LinkStart::kRevolute, lines[1]);
  EXPECT_NEAR(std::abs(link[0].value), 180 * kDeg, 1e-15);
  EXPECT_NEAR(link[1].value, 0.1, 1e-15);
  EXPECT_NEAR(link[2].value, 0.2, 1e-15);
  EXPECT_NEAR(link[3].value, -90 * kDeg, 1e-15);
}

}  // namespace
}  // namespace truepose
