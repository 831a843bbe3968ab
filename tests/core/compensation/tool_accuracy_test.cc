// The predicted accuracy of a tool.
#include "core/compensation/tool_accuracy.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "core/base/random.h"
#include "core/compensation/arm_from.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

Eigen::Vector3d Draw(const Eigen::Matrix3d& S, Random* random) {
  const Eigen::Vector3d normal(random->Normal(), random->Normal(), random->Normal());
  return S.llt().matrixL() * normal;
}

double PercentileOfNorms(const std::vector<Eigen::Matrix3d>& covariances, int draws) {
  Random random(5);
  std::vector<double> norms;
  for (int i = 0; i < draws; ++i)
    norms.push_back(Draw(covariances[i % covariances.size()], &random).norm());
  std::nth_element(norms.begin(), norms.begin() + draws * 95 / 100, norms.end());
  return norms[draws * 95 / 100];
}

// 100,000 draws give the percentile to 0.4 %; the approximation is right to 2 %. Would catch a
// radius of one axis, or of the mean square.
TEST(Radius95, HoldsNinetyFivePercentOfDraws) {
  for (const Eigen::Vector3d& sd :
       {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, 0.3, 0.1), Eigen::Vector3d(1, 1e-3, 1e-3)}) {
    const Eigen::Matrix3d S = sd.cwiseAbs2().asDiagonal();
    EXPECT_NEAR(Radius95(S) / PercentileOfNorms({S}, 100000), 1, 0.025) << sd.transpose();
  }
}

// Would catch the mean of radii, which is too small where poses differ.
TEST(Radius95, OfManyPosesIsThatOfTheirMixture) {
  const std::vector<Eigen::Matrix3d> covariances = {Eigen::Matrix3d::Identity(),
                                                    25 * Eigen::Matrix3d::Identity()};
  EXPECT_NEAR(Radius95(covariances) / PercentileOfNorms(covariances, 100000), 1, 0.025);
}

// Would catch a factor that takes RP for a standard deviation of distances.
TEST(DeviationOfRepeatability, IsThatOfScatterWithThisRepeatability) {
  Random random(9);
  std::vector<double> distances;
  double sum = 0;
  for (int i = 0; i < 200000; ++i) {
    distances.push_back(Draw(4 * Eigen::Matrix3d::Identity(), &random).norm());
    sum += distances.back();
  }
  const double mean = sum / static_cast<double>(distances.size());
  double squares = 0;
  for (double d : distances) squares += (d - mean) * (d - mean);
  const double rp = mean + 3 * std::sqrt(squares / static_cast<double>(distances.size()));
  EXPECT_NEAR(DeviationOfRepeatability(rp), 2, 0.02);  // 200,000 draws: 0.3 %
}

class AccuracyTest : public ::testing::Test {
 protected:
  AccuracyTest() {
    sources_.model = &model_;
    sources_.lambda = Eigen::VectorXd::Zero(model_.parameters.size());
    sources_.active = {0, 3, 5, 8};
    Random random(3);
    const Eigen::MatrixXd root =
        1e-4 * Eigen::MatrixXd::NullaryExpr(4, 4, [&] { return random.Uniform(-1, 1); });
    sources_.covariance = root * root.transpose();
  }

  const Robot robot_ = testing::Ur10();
  const Model model_ = ModifiedIncremental(robot_, ModelExtent::kInternal);
  AccuracySources sources_;
  const JointVector q_ = (Eigen::VectorXd(6) << 0.3, -1.2, 1.5, -1.8, -1.5, 0.7).finished();
  const Eigen::Vector3d p_F_{0.05, -0.02, 0.2};
};

// Against the true positions of drawn parameters. Would catch a Jacobian at another point than the
// tool's, or of other parameters. 40,000 draws: 1 % of a variance; second order of 1e-4 is nothing.
TEST_F(AccuracyTest, IsTheScatterOfDrawnParameters) {
  const Eigen::Matrix3d S = AccuracyAt(sources_, q_, p_F_).covariance;
  const Eigen::MatrixXd root = sources_.covariance.llt().matrixL();
  const Eigen::Vector3d middle = Forward(model_, q_, sources_.lambda) * p_F_;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Random random(4);
  constexpr int kDraws = 40000;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector4d normal(random.Normal(), random.Normal(), random.Normal(),
                                 random.Normal());
    Eigen::VectorXd lambda = sources_.lambda;
    lambda(sources_.active) += root * normal;
    const Eigen::Vector3d e = Forward(model_, q_, lambda) * p_F_ - middle;
    scatter += e * e.transpose() / kDraws;
  }
  EXPECT_LT((scatter - S).norm(), 0.05 * S.norm());
}

// Would catch a part that is left out, counted once for three axes, or a rotation that does not
// reach the tool through its distance from the calibrated target.
TEST_F(AccuracyTest, AddsWhatIsUnexplainedAndRepeatability) {
  const double parameters = AccuracyAt(sources_, q_, p_F_).rms_m;
  sources_.unexplained_m = 3e-4;
  sources_.unexplained_rad = 1e-3;
  sources_.p_F_target = p_F_ + Eigen::Vector3d(0.1, 0, 0);
  sources_.repeatability_m = 5e-5;
  const ToolAccuracy accuracy = AccuracyAt(sources_, q_, p_F_);
  EXPECT_NEAR(accuracy.parameters_m, parameters, 1e-15);
  EXPECT_NEAR(accuracy.unexplained_m, std::sqrt(3 * 9e-8 + 2 * 1e-8), 1e-12);
  EXPECT_NEAR(accuracy.repeatability_m, std::sqrt(3.0) * 5e-5, 1e-15);
  EXPECT_NEAR(accuracy.rms_m,
              std::hypot(accuracy.parameters_m, accuracy.unexplained_m, accuracy.repeatability_m),
              1e-15);
}

}  // namespace
}  // namespace truepose
