// Every Jacobian three ways: analytic = central difference = Jet, at home, at random and at zero
// rotation. Would catch a wrong sign, a column of the wrong element, a twist taken at the wrong
// point, and a derivative that forgets the residual.
//
// Tolerances: Jets are exact, so 1e-12 of entries of size 1 to 3; a central difference with h =
// 1e-6 has an error of h^2 = 1e-12 from the third derivative and of eps / h = 2e-10 from rounding,
// so 2e-9.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "core/identification/prediction.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using testing::RandomVector;

constexpr double kJetTolerance = 1e-12;
constexpr double kDifferenceTolerance = 2e-9;

// Twist at the base origin from the derivative of a pose: dX X^-1.
Eigen::Matrix<double, 6, 1> TwistOf(const Pose& X, const Eigen::Matrix3d& dR,
                                    const Eigen::Vector3d& dp) {
  const Eigen::Matrix3d W = dR * X.R.transpose();
  const Eigen::Vector3d w(W(2, 1), W(0, 2), W(1, 0));
  Eigen::Matrix<double, 6, 1> twist;
  twist << dp - w.cross(X.p), w;
  return twist;
}

Eigen::MatrixXd JetJacobian(const Chain& chain, const Eigen::VectorXd& q,
                            const Eigen::VectorXd& lambda, bool joints) {
  using Jet = ceres::Jet<double, 1>;
  const Eigen::Index n = joints ? q.size() : lambda.size();
  const Pose X = Forward(chain, q, lambda);
  Eigen::MatrixXd J(6, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    std::vector<Jet> qj(q.data(), q.data() + q.size()),
        lj(lambda.data(), lambda.data() + lambda.size());
    (joints ? qj : lj)[k].v[0] = 1;
    const PoseT<Jet> XJ = Forward<Jet>(chain, qj.data(), lj.data());
    J.col(k) = TwistOf(X, XJ.R.unaryExpr([](const Jet& x) { return x.v[0]; }),
                       XJ.p.unaryExpr([](const Jet& x) { return x.v[0]; }));
  }
  return J;
}

Eigen::MatrixXd DifferenceJacobian(const Chain& chain, Eigen::VectorXd q, Eigen::VectorXd lambda,
                                   bool joints) {
  const double h = 1e-6;
  const Pose X = Forward(chain, q, lambda);
  Eigen::VectorXd& v = joints ? q : lambda;
  Eigen::MatrixXd J(6, v.size());
  for (Eigen::Index k = 0; k < v.size(); ++k) {
    const double at = v(k);
    v(k) = at + h;
    const Pose plus = Forward(chain, q, lambda);
    v(k) = at - h;
    const Pose minus = Forward(chain, q, lambda);
    v(k) = at;
    J.col(k) = TwistOf(X, (plus.R - minus.R) / (2 * h), (plus.p - minus.p) / (2 * h));
  }
  return J;
}

void ExpectSweepLaws(const Chain& chain, const Eigen::VectorXd& q, const Eigen::VectorXd& lambda) {
  Sweep sweep;
  RunSweep(chain, q.data(), lambda.data(), &sweep);
  const Pose X = Forward(chain, q, lambda);
  EXPECT_EQ(sweep.X_0E.R, X.R);
  EXPECT_EQ(sweep.X_0E.p, X.p);
  EXPECT_LT((sweep.J_joints - JetJacobian(chain, q, lambda, true)).cwiseAbs().maxCoeff(),
            kJetTolerance);
  EXPECT_LT((sweep.J_parameters - JetJacobian(chain, q, lambda, false)).cwiseAbs().maxCoeff(),
            kJetTolerance);
  EXPECT_LT((sweep.J_joints - DifferenceJacobian(chain, q, lambda, true)).cwiseAbs().maxCoeff(),
            kDifferenceTolerance);
  EXPECT_LT(
      (sweep.J_parameters - DifferenceJacobian(chain, q, lambda, false)).cwiseAbs().maxCoeff(),
      kDifferenceTolerance);
}

TEST(JacobianLaws, ChainSweepAtHomeAndAtRandom) {
  Random random(11);
  for (const testing::CountedRobot& counted : testing::CountedRobots()) {
    SCOPED_TRACE(counted.name);
    const Model model = ModifiedIncremental(counted.robot, ModelExtent::kComplete);
    const int n = counted.robot.joint_count(), p = model.parameters.size();
    ExpectSweepLaws(model.chain, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(p));
    for (int draw = 0; draw < 5; ++draw) {
      ExpectSweepLaws(model.chain, RandomVector(n, 2, &random), RandomVector(p, 0.1, &random));
    }
  }
}

// A parameter that moves two elements gets the sum of their columns.
TEST(JacobianLaws, SharedParameterIsSummed) {
  const Chain chain = {{Motion::kRotation, Axis::kX, 0.1, 0, 0},
                       {Motion::kTranslation, Axis::kY, 0.5, -1, -1},
                       {Motion::kRotation, Axis::kZ, 0.2, 0, 0},
                       {Motion::kTranslation, Axis::kZ, 0.2, -1, 1}};
  ExpectSweepLaws(chain, Eigen::VectorXd::Constant(1, 0.4), Eigen::Vector2d(0.3, -0.2));
}

struct Point {
  Eigen::VectorXd base, tool, internal;
  Eigen::VectorXd offset = Eigen::VectorXd::Constant(1, 0.02);
};

ReadingPoint ParametersAt(const Point& at, const Pose& X_MB, const Pose& X_FT) {
  return {&X_MB, &X_FT, at.base.data(), at.tool.data(), at.offset(0), at.internal.data()};
}

// Residual derivatives by central difference of EvaluateReading without Jacobian.
Eigen::MatrixXd ResidualDifference(const Model& model, const Reading& reading, const Pose& X_MB,
                                   const Pose& X_FT, Point at, Eigen::VectorXd Point::*part) {
  const double h = 1e-6;
  Workspace workspace;
  Eigen::VectorXd& v = at.*part;
  Eigen::MatrixXd J(RowsOf(reading), v.size());
  for (Eigen::Index k = 0; k < v.size(); ++k) {
    const double value = v(k);
    Residual plus, minus;
    v(k) = value + h;
    EvaluateReading(model, reading, ParametersAt(at, X_MB, X_FT), &workspace, &plus, nullptr);
    v(k) = value - h;
    EvaluateReading(model, reading, ParametersAt(at, X_MB, X_FT), &workspace, &minus, nullptr);
    v(k) = value;
    J.col(k) = (plus - minus) / (2 * h);
  }
  return J;
}

void ExpectResidualLaws(const Model& model, const Reading& reading, const Pose& X_MB,
                        const Pose& X_FT, const Point& at) {
  Workspace workspace;
  Residual r, r_alone;
  ReadingJacobian J;
  EvaluateReading(model, reading, ParametersAt(at, X_MB, X_FT), &workspace, &r, &J);
  EvaluateReading(model, reading, ParametersAt(at, X_MB, X_FT), &workspace, &r_alone, nullptr);
  EXPECT_LT((r - r_alone).norm(), 1e-14);
  // Rotation residuals of up to 1 rad magnify rounding a little.
  const double tolerance = 5 * kDifferenceTolerance;
  EXPECT_LT((J.base - ResidualDifference(model, reading, X_MB, X_FT, at, &Point::base))
                .cwiseAbs()
                .maxCoeff(),
            tolerance);
  EXPECT_LT((J.tool - ResidualDifference(model, reading, X_MB, X_FT, at, &Point::tool))
                .cwiseAbs()
                .maxCoeff(),
            tolerance);
  EXPECT_LT((J.offset - ResidualDifference(model, reading, X_MB, X_FT, at, &Point::offset))
                .cwiseAbs()
                .maxCoeff(),
            tolerance);
  EXPECT_LT((J.internal - ResidualDifference(model, reading, X_MB, X_FT, at, &Point::internal))
                .cwiseAbs()
                .maxCoeff(),
            tolerance);
}

class ResidualLaws : public ::testing::TestWithParam<ObservationKind> {};

// `off` is how far the measurement is from the prediction, in rad and tenths of m.
void CheckResidual(ObservationKind kind, double off, uint64_t seed) {
  Random random(seed);
  const Robot robot = testing::Ur10();
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  const Pose X_MB{ExpRotation<double>(RandomVector(3, 1.5, &random)), RandomVector(3, 2, &random)};
  const Pose X_FT{ExpRotation<double>(RandomVector(3, 1, &random)), RandomVector(3, 0.2, &random)};
  const Point at{RandomVector(6, 0.05, &random), RandomVector(6, 0.05, &random),
                 RandomVector(model.parameters.size(), 0.02, &random)};
  Reading reading;
  reading.kind = kind;
  reading.q = RandomVector(6, 2, &random);
  const Pose X_MT = Corrected(X_MB, at.base.data(), nullptr) *
                    Forward(model.chain, reading.q, at.internal) *
                    Corrected(X_FT, at.tool.data(), nullptr);
  reading.X_MT = {ExpRotation<double>(RandomVector(3, off, &random)) * X_MT.R,
                  X_MT.p + RandomVector(3, off, &random)};
  reading.axis_M = reading.X_MT.R.col(2);
  reading.normal_M = RandomVector(3, 1, &random).normalized();
  reading.coordinates = {true, false, true};
  reading.anchor_M = RandomVector(3, 2, &random);
  reading.distance_m = (X_MT.p - reading.anchor_M).norm() + off;
  if (kind == ObservationKind::kDistance) reading.offset = 0;
  ExpectResidualLaws(model, reading, X_MB, X_FT, at);
}

TEST_P(ResidualLaws, AtZeroResidual) { CheckResidual(GetParam(), 0, 1); }
TEST_P(ResidualLaws, AtSmallResidual) {
  for (uint64_t seed = 2; seed < 8; ++seed) CheckResidual(GetParam(), 1e-3, seed);
}
TEST_P(ResidualLaws, AtLargeResidual) {
  for (uint64_t seed = 8; seed < 14; ++seed) CheckResidual(GetParam(), 0.6, seed);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ResidualLaws,
                         ::testing::Values(ObservationKind::kPose, ObservationKind::kPoint,
                                           ObservationKind::kPointAxis,
                                           ObservationKind::kCoordinates,
                                           ObservationKind::kDistance, ObservationKind::kPlane),
                         [](const auto& info) { return std::string(KindOf(info.param).name); });

}  // namespace
}  // namespace truepose
