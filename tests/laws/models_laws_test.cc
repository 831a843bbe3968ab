// Laws of every kind of model on every robot: derivatives, and that small errors need small
// parameters. Would catch a column of the wrong element, a tilt's derivative that forgets gamma, a
// D&H link at parallel axes and a Hayati link at coincident ones.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/core/testing/models.h"

namespace truepose {
namespace {

using testing::ModelOf;
using testing::RandomVector;

// Twist at the base origin from the central difference of a pose.
Eigen::Matrix<double, 6, 1> DifferenceTwist(const Pose& X, const Pose& plus, const Pose& minus,
                                            double h) {
  const Eigen::Matrix3d W = (plus.R - minus.R) / (2 * h) * X.R.transpose();
  const Eigen::Vector3d w(W(2, 1), W(0, 2), W(1, 0)), v = (plus.p - minus.p) / (2 * h);
  Eigen::Matrix<double, 6, 1> twist;
  twist << v - w.cross(X.p), w;
  return twist;
}

// h = 1e-6: 1e-12 from the third derivative, 2e-10 from rounding of entries of size up to 3.
void ExpectJacobian(const Model& model, const Eigen::VectorXd& q, const Eigen::VectorXd& lambda,
                    const Conditions& conditions) {
  const double h = 1e-6;
  ModelSweep sweep;
  RunSweep(model, q.data(), lambda.data(), conditions, &sweep);
  const Pose X = Forward(model, q, lambda, conditions);
  EXPECT_EQ(sweep.X_BF.R, X.R);
  EXPECT_EQ(sweep.X_BF.p, X.p);
  ASSERT_EQ(sweep.J_parameters.cols(), lambda.size());
  for (Eigen::Index k = 0; k < lambda.size(); ++k) {
    Eigen::VectorXd plus = lambda, minus = lambda;
    plus(k) += h;
    minus(k) -= h;
    const auto twist = DifferenceTwist(X, Forward(model, q, plus, conditions),
                                       Forward(model, q, minus, conditions), h);
    EXPECT_LT((sweep.J_parameters.col(k) - twist).cwiseAbs().maxCoeff(), 5e-9)
        << model.parameters[static_cast<int>(k)].name;
  }
}

TEST(ModelLaws, JacobianIsTheDifference) {
  Random random(91);
  for (const testing::NamedRobot& named : testing::AllRobots()) {
    for (const std::string& kind : ModelKinds()) {
      SCOPED_TRACE(named.name + ", " + kind);
      const Model model = ModelOf(kind, named.robot, ModelExtent::kComplete);
      const int n = named.robot.joint_count(), p = model.parameters.size();
      ExpectJacobian(model, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(p), {});
      for (double size : {1e-3, 0.2})
        ExpectJacobian(model, RandomVector(n, 2, &random), RandomVector(p, size, &random), {});
    }
  }
}

// Effects stand behind the geometric parameters, also where the chain has parameters that the model
// has not (the tilts' gamma).
TEST(ModelLaws, JacobianWithEffects) {
  Random random(92);
  for (const std::string& kind : ModelKinds()) {
    SCOPED_TRACE(kind);
    const Robot robot = testing::Stanford();
    Model model = ModelOf(kind, robot, ModelExtent::kComplete);
    for (EffectGroup group : AllEffectGroups())
      if (group != EffectGroup::kCompliance) AddEffects(robot, group, &model);
    Conditions conditions;
    conditions.temperature_K = 3;
    ExpectJacobian(model, RandomVector(6, 1, &random),
                   RandomVector(model.parameters.size(), 0.02, &random), conditions);
  }
}

// Parametric continuity: parameters of 1e-5 (m, rad) move the flange, 3 m away at most, by no more
// than their sum times 3 m and 1 rad.
TEST(ModelLaws, SmallParametersMoveLittle) {
  Random random(93);
  for (const testing::NamedRobot& named : testing::AllRobots()) {
    for (const std::string& kind : ModelKinds()) {
      SCOPED_TRACE(named.name + ", " + kind);
      const Model model = ModelOf(kind, named.robot, ModelExtent::kComplete);
      const Eigen::VectorXd lambda = RandomVector(model.parameters.size(), 1e-5, &random);
      for (int draw = 0; draw < 10; ++draw) {
        const Eigen::VectorXd q = RandomVector(named.robot.joint_count(), 2, &random);
        const Pose X = Forward(model, q, lambda), nominal = NominalForward(named.robot, q);
        EXPECT_LT((X.p - nominal.p).norm(), 3 * lambda.lpNorm<1>());
        EXPECT_LT((X.R - nominal.R).norm(), 2 * lambda.lpNorm<1>());
      }
    }
  }
}

// And the other way round, which is what singular forms fail: errors of 1e-5 of every axis, as the
// modified incremental model states them, are expressed by parameters of at most 1e-3. The factor
// of 100 leaves room for an arm's length by a Hayati length of centimetres; at parallel axes D&H
// needs parameters without bound.
TEST(ModelLaws, SmallErrorsNeedSmallParameters) {
  Random random(94);
  for (const testing::NamedRobot& named : testing::AllRobots()) {
    const Model reference = ModelOf("modified_incremental", named.robot, ModelExtent::kComplete);
    const Eigen::VectorXd errors = testing::StackedJacobian(named.robot, reference, 60, 95) *
                                   RandomVector(reference.parameters.size(), 1e-5, &random);
    for (const std::string& kind : ModelKinds()) {
      SCOPED_TRACE(named.name + ", " + kind);
      const Model model = ModelOf(kind, named.robot, ModelExtent::kComplete);
      const Eigen::MatrixXd J = testing::StackedJacobian(named.robot, model, 60, 95);
      Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
      solver.setThreshold(1e-9);
      solver.compute(J);
      const Eigen::VectorXd lambda = solver.solve(errors);
      EXPECT_LT((J * lambda - errors).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_LT(lambda.cwiseAbs().maxCoeff(), 1e-3);
    }
  }
}

}  // namespace
}  // namespace truepose
