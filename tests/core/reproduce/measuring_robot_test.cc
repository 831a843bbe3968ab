#include "core/reproduce/measuring_robot.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/identification/identifiability.h"
#include "core/reproduce/dime.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using testing::kDeg;

Eigen::VectorXd Parameters(const Model& model,
                           const std::vector<std::pair<std::string, double>>& values) {
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(model.parameters.size());
  for (const auto& [name, value] : values) lambda(model.parameters.Find(name).value()) = value;
  return lambda;
}

// As printed in the chapter, written out.
Eigen::Matrix4d Eq33(double x, double y, double chi, double psi) {
  const double cp = std::cos(psi), sp = std::sin(psi), cc = std::cos(chi), sc = std::sin(chi);
  Eigen::Matrix4d A;
  A << cp, 0, sp, x, sc * sp, cc, -sc * cp, y, -cc * sp, sc, cc * cp, 0, 0, 0, 0, 1;
  return A;
}

Eigen::Matrix4d Eq34(double th, double d, double a, double al) {
  const double c = std::cos(th), s = std::sin(th), ca = std::cos(al), sa = std::sin(al);
  Eigen::Matrix4d A;
  A << c, -s * ca, s * sa, a * c, s, c * ca, -c * sa, a * s, 0, sa, ca, d, 0, 0, 0, 1;
  return A;
}

Eigen::Matrix4d Eq35(double th, double a, double al, double y) {
  const double c = std::cos(th), s = std::sin(th), ca = std::cos(al), sa = std::sin(al),
               cy = std::cos(y), sy = std::sin(y);
  Eigen::Matrix4d A;
  A << c * cy - s * sa * sy, -s * ca, c * sy + s * sa * cy, a * c,  //
      s * cy + c * sa * sy, c * ca, s * sy - c * sa * cy, a * s,    //
      -ca * sy, sa, ca * cy, 0, 0, 0, 0, 1;
  return A;
}

// Against the matrices of Eqs. 33 to 36 at errors in all sorts of parameters. Would catch a wrong
// order inside A_0 or A_2, a nominal value of Eq. 37 as printed (a_2 and alpha_2 exchanged), and a
// d_2 that moves something.
TEST(MeasuringRobot, IsTheProductOfTheChaptersMatrices) {
  const Model model = MeasuringRobot();
  const Eigen::VectorXd lambda =
      Parameters(model, {{"X0", .01},  {"Y0", -.02}, {"chi0", .03}, {"psi0", -.05}, {"th1", .1},
                         {"d1", .011}, {"a1", .012}, {"al1", -.07}, {"th2", .2},    {"a2", .013},
                         {"al2", .11}, {"y2", .13},  {"th3", -.1},  {"d3", .02},    {"a3", -.03},
                         {"al3", .06}, {"th4", .3},  {"d4", .004},  {"a4", .005},   {"al4", .08},
                         {"th5", -.2}, {"d5", .006}, {"a5", .007},  {"al5", .09},   {"Zp", .008}});
  Eigen::VectorXd q(5);
  q << .3, .8, -1.2, .5, -.7;
  Eigen::Matrix4d A6 = Eigen::Matrix4d::Identity();
  A6(2, 3) = .161 + .008;
  const Eigen::Matrix4d M = Eq33(.01, -.02, .03, -.05) *
                            Eq34(q(0) + .1, .252 + .011, .012, 90 * kDeg - .07) *
                            Eq35(q(1) + .2, .320 + .013, .11, .13) *
                            Eq34(q(2) + 90 * kDeg - .1, .02, -.03, 90 * kDeg + .06) *
                            Eq34(q(3) + .3, .330 + .004, .005, 90 * kDeg + .08) *
                            Eq34(q(4) - 90 * kDeg - .2, .006, .007, 90 * kDeg + .09) * A6;
  const Pose X = Forward(model, q, lambda);
  // A dozen products of numbers near 1.
  EXPECT_LT((X.R - M.topLeftCorner<3, 3>()).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((X.p - M.topRightCorner<3, 1>()).cwiseAbs().maxCoeff(), 1e-14);
}

int RankOverDime(ObservationKind kind) {
  const Model model = MeasuringRobot();
  Problem problem = MeasuringRobotProblem(model, {});
  for (const DimePose& pose : Dime()) {
    Reading reading;
    reading.kind = kind;
    reading.q = *NominalJoints(pose);
    reading.X_MT = Forward(model, reading.q, Eigen::VectorXd::Zero(25));
    reading.axis_M = pose.hole.axis_M;
    problem.readings.push_back(reading);
  }
  const Eigen::MatrixXd J =
      Whitened(problem, NominalEstimate(problem), {1e-4, 1e-4}).J.rightCols(25);
  return static_cast<int>(Identifiable(J, model.parameters, {}).active.size());
}

// Eq. 12 with G = 5: all 25 on the dime's own poses. With the point alone a5 acts as th5 and d5 as
// al5. Would catch the nominals as printed, whose rank is 24.
TEST(MeasuringRobot, TheDimeDeterminesAll25) {
  EXPECT_EQ(MeasuringRobot().parameters.size(), 25);
  EXPECT_EQ(RankOverDime(ObservationKind::kPointAxis), 25);
  EXPECT_EQ(RankOverDime(ObservationKind::kPoint), 23);
}

// Would catch a name in both sets, in none, or misspelt.
TEST(MeasuringRobot, ReducedAndAdditionalSetsMakeUpTheModel) {
  std::set<std::string> names(ReducedSet().begin(), ReducedSet().end());
  names.insert(AdditionalSet().begin(), AdditionalSet().end());
  EXPECT_EQ(ReducedSet().size(), 14u);
  EXPECT_EQ(AdditionalSet().size(), 11u);
  EXPECT_EQ(names.size(), 25u);
  const Model model = MeasuringRobot();
  for (const Parameter& parameter : model.parameters) EXPECT_TRUE(names.contains(parameter.name));
}

}  // namespace
}  // namespace truepose
