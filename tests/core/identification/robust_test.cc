#include "core/identification/robust.h"

#include <gtest/gtest.h>

#include "core/calibrate/calibrate.h"
#include "tests/core/testing/robots.h"
#include "tests/core/testing/simulated.h"

namespace truepose {
namespace {

TEST(Robust, WeightsAtTheirThresholds) {
  EXPECT_EQ(LossWeight(Loss::kNone, 100, 3), 1);
  EXPECT_EQ(LossWeight(Loss::kHuber, 1.3, 1), 1);
  EXPECT_NEAR(LossWeight(Loss::kHuber, 2 * 1.345, 1), 0.5, 1e-3) << "c is 1.345 for one row";
  EXPECT_EQ(LossWeight(Loss::kTukey, 4.69, 1), 0) << "c is 4.685 for one row";
  EXPECT_NEAR(LossWeight(Loss::kTukey, 4.685 / std::sqrt(2.0), 1), 0.25, 1e-9);
  EXPECT_GT(LossWeight(Loss::kTukey, 4.69, 6), 0.1) << "six rows are larger together";
}

// E[(w r)^2] / E[w] of normal draws, counted instead of integrated.
TEST(Robust, ConsistencyIsThatOfNormalResiduals) {
  Random random(5);
  for (Loss loss : {Loss::kHuber, Loss::kTukey}) {
    for (int rows : {1, 3, 6}) {
      double weighted = 0, weights = 0;
      for (int i = 0; i < 200000; ++i) {
        double squared = 0;
        for (int row = 0; row < rows; ++row) {
          const double z = random.Normal();
          squared += z * z;
        }
        const double w = LossWeight(loss, std::sqrt(squared), rows);
        weighted += w * w * squared;
        weights += w;
      }
      // 200,000 draws: a standard error of about 0.003.
      EXPECT_NEAR(Consistency(loss, rows), weighted / (rows * weights), 0.012)
          << Name(loss) << " " << rows;
    }
  }
  EXPECT_EQ(Consistency(Loss::kNone, 6), 1);
}

double LargestError(const testing::Simulated& simulated, const CalibrationResult& result) {
  double largest = 0;
  for (int candidate : result.identification.set.active) {
    const int index = candidate - 12;
    if (index < 0) continue;
    largest = std::max(largest, std::abs(result.identification.estimate.lambda(index) -
                                         simulated.session().lambda(index)));
  }
  return largest;
}

// 6 of 60 readings are off by 20 mm. Plain least squares follows them; a loss does not, keeps the
// noise of the good ones as its scale, and names exactly the six.
TEST(Robust, OutliersLoseTheirWeight) {
  SimulateOptions options;
  options.poses = 60;
  options.seed = 4;
  const testing::Simulated simulated(testing::Ur10(), testing::AnyTarget(), options);
  CalibrationProblem problem = simulated.Problem(ObservationKind::kPose, 0);
  for (int i = 0; i < 6; ++i) problem.readings[10 * i].X_MT.p.x() += i % 2 == 0 ? 0.02 : -0.02;
  std::map<Loss, double> sd;
  for (Loss loss : {Loss::kNone, Loss::kHuber, Loss::kTukey}) {
    CalibrateOptions calibrate;
    calibrate.identify.loss = loss;
    const auto result = Calibrate(problem, calibrate, {});
    ASSERT_TRUE(result.ok()) << result.status();
    sd[loss] = result->identification.model_error.position_sd_m;
    // s_model settled on 1 to 1e-4 of its weights. Would catch a variance of the limited residuals
    // (0.6 to 0.9) and one of the whole residuals of outliers (in the thousands).
    EXPECT_NEAR(result->identification.weighted_residual_variance, 1, 1e-2) << Name(loss);
    ASSERT_EQ(result->suspects.size(), 6u) << Name(loss);
    for (const Suspect& suspect : result->suspects) {
      EXPECT_EQ(suspect.reading % 10, 0);
      EXPECT_NE(suspect.reason.find("position off by"), std::string::npos) << suspect.reason;
      EXPECT_LT(suspect.weight, loss == Loss::kNone ? 1.1 : 0.1);
    }
    if (loss == Loss::kTukey) {
      EXPECT_EQ(result->suspects[0].weight, 0);
    }
  }
  EXPECT_GT(sd[Loss::kNone], 1e-3);
  EXPECT_NEAR(sd[Loss::kTukey], 5e-5, 2e-5) << "the noise that was drawn";
}

// On readings without outliers a loss must not cost accuracy.
TEST(Robust, CleanReadingsKeepTheirResult) {
  SimulateOptions options;
  options.poses = 80;
  options.seed = 9;
  const testing::Simulated simulated(testing::Ur10(), testing::AnyTarget(), options);
  const CalibrationProblem problem = simulated.Problem(ObservationKind::kPose, 0);
  CalibrateOptions plain, tukey;
  tukey.identify.loss = Loss::kTukey;
  const auto a = Calibrate(problem, plain, {}), b = Calibrate(problem, tukey, {});
  ASSERT_TRUE(a.ok() && b.ok());
  // The loss' efficiency is above 90 %: errors grow by some per cent, not by factors.
  EXPECT_LT(LargestError(simulated, *b), 2 * LargestError(simulated, *a));
  EXPECT_NEAR(b->identification.model_error.position_sd_m,
              a->identification.model_error.position_sd_m, 1e-5);
  EXPECT_TRUE(b->suspects.empty());
}

}  // namespace
}  // namespace truepose
