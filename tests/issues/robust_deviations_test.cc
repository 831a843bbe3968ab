// Standard deviations under a robust loss were those of weighted least squares, (J'WJ)^-1, and the
// weighted residual variance, which says 1 where the weights fit, settled at 0.5 to 0.6 with Tukey.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/calibrate/calibrate.h"
#include "tests/core/testing/robots.h"
#include "tests/core/testing/simulated.h"

namespace truepose {
namespace {

// A plane arm, few parameters: 200 fits in seconds.
Robot Plane() { return testing::DhRobot({{0, 0, 0.4, 0}, {0, 0, 0.3, 0}}, "RR"); }

struct Spread {
  double ratio = 0;     // squared errors by their variances, mean over seeds
  double variance = 0;  // weighted residual variance, mean over seeds
};

// The session without noise; lengths are wrong, no axis tilted, so that what a plane arm leaves
// open (the height of its target) moves nothing.
SimulateOptions Exact() {
  SimulateOptions options;
  options.poses = 40;
  options.seed = 7;
  options.angle_error_sd_rad = 0;
  options.position_noise_sd_m = options.rotation_noise_sd_rad = 0;
  return options;
}

Spread SpreadOf(Loss loss, double outliers) {
  const testing::Simulated simulated(Plane(), testing::AnyTarget(), Exact());
  const SimulatedSession& session = simulated.session();
  Problem problem{
      &simulated.model(), simulated.Problem(ObservationKind::kPoint, 0).readings, {""}, {""}};
  const IdentifiableSet generic = GenericIdentifiable(problem, simulated.robot());
  const int da1 = *simulated.model().parameters.Find("da1");
  const std::vector<Reading> exact = problem.readings;
  Estimate start = NominalEstimate(problem);
  start.X_MB[0] = session.X_MB;
  start.X_FT[0] = session.X_FT;
  IdentifyOptions options;
  options.loss = loss;
  constexpr int kSeeds = 200;
  Spread spread;
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Random random(seed);
    problem.readings = exact;
    for (Reading& reading : problem.readings) {
      const double sd = random.Uniform(0, 1) < outliers ? 2e-3 : 1e-4;
      for (int i = 0; i < 3; ++i) reading.X_MT.p(i) += sd * random.Normal();
    }
    const auto before = FitFrames(problem, start, options, {});
    const auto result = Identify(problem, generic, *before, options, {});
    EXPECT_TRUE(result.ok()) << result.status();
    const std::vector<int>& active = result->set.active;
    const auto place = std::find(active.begin(), active.end(), problem.FirstInternal() + da1);
    EXPECT_NE(place, active.end());
    const double error = result->estimate.lambda(da1) - session.lambda(da1);
    const Eigen::Index k = place - active.begin();
    spread.ratio += error * error / result->covariance(k, k) / kSeeds;
    spread.variance += result->weighted_residual_variance / kSeeds;
  }
  return spread;
}

// 200 squares of a normal: their mean has a standard error of 10 %, that of the root 5 %; 10 % of
// the deviation is two of them.
TEST(RobustDeviations, AreTheScatter) {
  for (const Loss loss : {Loss::kHuber, Loss::kTukey}) {
    const Spread spread = SpreadOf(loss, 0.1);
    EXPECT_NEAR(std::sqrt(spread.ratio), 1, 0.1) << Name(loss);
    EXPECT_NEAR(spread.variance, 1, 0.1) << Name(loss);
  }
}

}  // namespace
}  // namespace truepose
