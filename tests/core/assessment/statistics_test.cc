#include "core/assessment/statistics.h"

#include <gtest/gtest.h>

#include "core/assessment/verdict.h"
#include "core/base/random.h"

namespace truepose {
namespace {

// By hand; rms^2 = mean^2 + sd^2 holds for the population's deviation only.
TEST(Statistics, OfFourSizes) {
  const Statistics s = StatisticsOf({1, 2, 3, 6});
  EXPECT_DOUBLE_EQ(s.mean, 3);
  EXPECT_DOUBLE_EQ(s.sd, std::sqrt(3.5));
  EXPECT_DOUBLE_EQ(s.rms, std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(s.max, 6);
}

TEST(Statistics, OfNothingIsZero) {
  const Statistics s = StatisticsOf({});
  EXPECT_EQ(s.mean + s.sd + s.rms + s.max, 0);
}

// Readings without orientation don't dilute the rotation's figures.
TEST(Statistics, RotationOnlyWhereMeasured) {
  const PoseStatistics s = PoseStatisticsOf({{0, 1, -1}, {1, 3, 0.5}});
  EXPECT_EQ(s.poses, 2);
  EXPECT_DOUBLE_EQ(s.position_m.mean, 2);
  EXPECT_DOUBLE_EQ(s.rotation_rad.mean, 0.5);
  EXPECT_TRUE(s.has_rotation);
  EXPECT_FALSE(PoseStatisticsOf({{0, 1, -1}}).has_rotation);
}

std::vector<PoseError> Errors(const std::vector<double>& sizes) {
  std::vector<PoseError> errors;
  for (double size : sizes) errors.push_back({0, size, -1});
  return errors;
}

// A constant ratio has no spread; pairing matters: the same ratio in each row, whatever the rows'
// sizes.
TEST(Verdict, BootstrapIsPaired) {
  const auto [low, high] = BootstrapRatio(Errors({1, 5, 0.2, 9}), Errors({0.5, 2.5, 0.1, 4.5}));
  EXPECT_NEAR(low, 0.5, 1e-12);
  EXPECT_NEAR(high, 0.5, 1e-12);
}

// Hand-made: 20 rows, half of them twice as large after. The interval spans 95 % of what draws of
// rows give.
TEST(Verdict, BootstrapIntervalHasItsWidth) {
  std::vector<double> before(200, 1.0), after;
  for (int i = 0; i < 200; ++i) after.push_back(i % 2 == 0 ? 2.0 : 0.5);
  const auto [low, high] = BootstrapRatio(Errors(before), Errors(after));
  // Mean of squares 2.125, its deviation 1.875 / sqrt(200) = 0.1326; +- 1.96 of it, then the root.
  EXPECT_NEAR(low, std::sqrt(2.125 - 1.96 * 0.1326), 0.02);
  EXPECT_NEAR(high, std::sqrt(2.125 + 1.96 * 0.1326), 0.02);
}

// The two quantiles are as far from their ends: exchanged sets give exactly the reciprocal
// interval.
TEST(Verdict, BootstrapIsSymmetric) {
  std::vector<double> a, b;
  Random random(95);
  for (int i = 0; i < 30; ++i) {
    a.push_back(random.Uniform(0.5, 2));
    b.push_back(random.Uniform(0.5, 2));
  }
  const Interval ratio = BootstrapRatio(Errors(a), Errors(b)),
                 inverse = BootstrapRatio(Errors(b), Errors(a));
  EXPECT_NEAR(ratio.low * inverse.high, 1, 1e-12);
  EXPECT_NEAR(ratio.high * inverse.low, 1, 1e-12);
}

Identification Converged() {
  Identification identification;
  identification.summary.termination = Termination::kConverged;
  identification.set.active = {0};  // without frames the first candidate is internal
  return identification;
}

TEST(Verdict, Decisions) {
  const auto better = Errors({0.5, 0.4, 0.6, 0.5, 0.5, 0.4, 0.6, 0.5, 0.4, 0.6}),
             worse = Errors({1, 1.1, 0.9, 1.2, 1, 1.1, 0.9, 1.2, 1, 1.1});
  EXPECT_EQ(Judge(Converged(), {}, worse, better).decision, Decision::kApply);
  EXPECT_EQ(Judge(Converged(), {}, better, worse).decision, Decision::kDoNotApply);
  EXPECT_EQ(Judge(Converged(), {}, worse, worse).decision, Decision::kDoNotApply)
      << "no change is no improvement";
  EXPECT_EQ(Judge(Converged(), {}, {}, {}).decision, Decision::kApplyWithinVolume);
  EXPECT_EQ(Judge(Converged(), {}, Errors({1, 1, 1}), Errors({0.4, 0.4, 0.4})).decision,
            Decision::kApplyWithinVolume)
      << "three rows prove little";
  EXPECT_EQ(Judge(Converged(), {}, Errors({1, 1, 1}), Errors({2, 2, 2})).decision,
            Decision::kDoNotApply);
  Identification dropped = Converged();
  dropped.set.redundancies.push_back({3, {}, true, false});
  EXPECT_EQ(Judge(dropped, {}, worse, better).decision, Decision::kApplyWithinVolume);
  dropped.set.redundancies[0].structural = true;
  EXPECT_EQ(Judge(dropped, {}, worse, better).decision, Decision::kApply);
  EXPECT_EQ(Judge(dropped, {}, better, worse).decision, Decision::kDoNotApply);
  Identification unfinished = Converged();
  unfinished.summary.termination = Termination::kIterationLimit;
  EXPECT_EQ(Judge(unfinished, {}, worse, better).decision, Decision::kDoNotApply);
  EXPECT_FALSE(Judge(unfinished, {}, worse, better).reasons.empty());
}

// A wrong robot file can improve the control set with a joint that is 40 deg off.
TEST(Verdict, ImplausibleCorrections) {
  const auto better = Errors({0.5, 0.4, 0.6, 0.5, 0.5, 0.4, 0.6, 0.5, 0.4, 0.6}),
             worse = Errors({1, 1.1, 0.9, 1.2, 1, 1.1, 0.9, 1.2, 1, 1.1});
  ParameterSet parameters;
  parameters.Add({"dq1", ParameterGroup::kInternal, ParameterRole::kJointOffset, Unit::kRadian});
  parameters.Add({"da1", ParameterGroup::kInternal, ParameterRole::kLength, Unit::kMetre});
  Identification identification = Converged();
  identification.estimate.lambda = Eigen::Vector2d(-0.17, 0.09);
  EXPECT_EQ(Judge(identification, parameters, worse, better).decision, Decision::kApply);
  identification.estimate.lambda = Eigen::Vector2d(-0.7, 0.09);
  const Verdict angle = Judge(identification, parameters, worse, better);
  EXPECT_EQ(angle.decision, Decision::kDoNotApply);
  EXPECT_NE(angle.reasons.back().find("dq1 = -40.11 deg"), std::string::npos);
  identification.estimate.lambda = Eigen::Vector2d(0, 0.11);
  EXPECT_EQ(Judge(identification, parameters, worse, better).decision, Decision::kDoNotApply);
}

}  // namespace
}  // namespace truepose
