#include "core/identification/weights.h"

#include <gtest/gtest.h>

#include "core/identification/prediction.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

// Readings of a robot that is exact, with noise of the given size.
Problem NoisyProblem(const Model& model, int readings, double position_sd, double rotation_sd,
                     const Eigen::Vector3d& stated) {
  Problem problem{&model, {}, {""}, {""}};
  const Estimate estimate = NominalEstimate(problem);
  Random random(71);
  const auto noise = [&](double sd) {
    return Eigen::Vector3d(sd * random.Normal(), sd * random.Normal(), sd * random.Normal());
  };
  for (int i = 0; i < readings; ++i) {
    Reading reading;
    reading.q = testing::RandomVector(6, 1.5, &random);
    reading.X_MT = Predict(problem, reading, estimate);
    const Eigen::Vector3d stated_noise(stated.x() * random.Normal(), stated.y() * random.Normal(),
                                       stated.z() * random.Normal());
    reading.X_MT.p += noise(position_sd) + stated_noise;
    reading.X_MT.R = ExpRotation<double>(noise(rotation_sd)) * reading.X_MT.R;
    reading.position_sd_m = stated;
    problem.readings.push_back(reading);
  }
  return problem;
}

const std::vector<int> kFrames = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};

// 500 readings give the deviation to 2 %; stated scatter is taken off, whatever the weights were
// before.
TEST(Weights, ModelErrorIsWhatTheStatedScatterLeaves) {
  const Model model = ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal);
  const Problem problem = NoisyProblem(model, 500, 4e-4, 6e-4, Eigen::Vector3d(1e-4, 3e-4, 6e-4));
  ModelError error{1e-3, 1e-2};
  for (int round = 0; round < 3; ++round)
    error = EstimateModelError(problem, NominalEstimate(problem), {}, error);
  EXPECT_NEAR(error.position_sd_m, 4e-4, 2e-5);
  EXPECT_NEAR(error.rotation_sd_rad, 6e-4, 3e-5);
}

// Six readings: 36 rows, of which 12 parameters of frames take a third. Without their share the
// estimate is too small by sqrt(1 - 12/36) when the residuals are those after the fit; here they
// are not fitted, so it is too large by the inverse.
TEST(Weights, ParametersTakeTheirShare) {
  const Model model = ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal);
  const Problem problem = NoisyProblem(model, 6, 4e-4, 6e-4, Eigen::Vector3d::Zero());
  const Estimate at = NominalEstimate(problem);
  const ModelError without = EstimateModelError(problem, at, {}, {}),
                   with = EstimateModelError(problem, at, kFrames, {});
  const double share_p = 18 * (1 - std::pow(without.position_sd_m / with.position_sd_m, 2));
  const double share_r = 18 * (1 - std::pow(without.rotation_sd_rad / with.rotation_sd_rad, 2));
  EXPECT_NEAR(share_p + share_r, 12, 1e-6);
}

TEST(Weights, StatedScatterAloneExplains) {
  const Model model = ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal);
  Problem problem = NoisyProblem(model, 100, 1e-5, 1e-5, Eigen::Vector3d::Zero());
  for (Reading& reading : problem.readings) reading.position_sd_m.setConstant(1e-3);
  EXPECT_NEAR(EstimateModelError(problem, NominalEstimate(problem), {}, {}).position_sd_m, 1e-7,
              1e-12);
}

// Exact data must not divide by zero.
TEST(Weights, ExactReadingsGiveTheFloor) {
  const Model model = ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal);
  const Problem problem = NoisyProblem(model, 20, 0, 0, Eigen::Vector3d::Zero());
  const ModelError error = EstimateModelError(problem, NominalEstimate(problem), {}, {});
  EXPECT_NEAR(error.position_sd_m, 1e-7, 1e-12);
  EXPECT_NEAR(error.rotation_sd_rad, 1e-8, 1e-13);
}

TEST(Weights, DeviationsAddInSquares) {
  const Model model = ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal);
  Problem problem = NoisyProblem(model, 1, 0, 0, Eigen::Vector3d(3e-4, 0, 0));
  const Estimate at = NominalEstimate(problem);
  Residual sd = CovarianceOf(problem, problem.readings[0], at, {4e-4, 2e-3}).diagonal().cwiseSqrt();
  ASSERT_EQ(sd.size(), 6);
  EXPECT_DOUBLE_EQ(sd(0), 5e-4);
  EXPECT_DOUBLE_EQ(sd(1), 4e-4);
  EXPECT_DOUBLE_EQ(sd(5), 2e-3);
  problem.readings[0].kind = ObservationKind::kPoint;
  EXPECT_EQ(CovarianceOf(problem, problem.readings[0], at, {}).rows(), 3);
}

// Rows, deviations and columns of the stacked system belong together: a row's Jacobian is that of
// its own reading.
TEST(Weights, WhitenedSystemStacksReadings) {
  const Model model = ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal);
  Problem problem = NoisyProblem(model, 3, 1e-3, 1e-3, Eigen::Vector3d::Zero());
  problem.readings[1].kind = ObservationKind::kPoint;
  problem.placements = {"a", "b"};
  problem.readings[2].placement = 1;
  const Estimate at = NominalEstimate(problem);
  const WhitenedSystem system = Whitened(problem, at, {2e-3, 5e-3});
  ASSERT_EQ(system.r.size(), 15);
  EXPECT_EQ(system.raw.segment<3>(6), ResidualAt(problem, problem.readings[1], at));
  EXPECT_EQ(system.kind[8], WhitenedSystem::Row::kPosition);
  EXPECT_EQ(system.kind[12], WhitenedSystem::Row::kRotation);
  EXPECT_DOUBLE_EQ(system.sd(12), 5e-3);
  EXPECT_NEAR(system.J(0, 0), -1 / 2e-3, 1e-9);
  EXPECT_EQ(system.J(0, 6), 0) << "the first reading does not see the second placement";
  EXPECT_NEAR(system.J(9, 6), -1 / 2e-3, 1e-9);
  EXPECT_EQ(system.J(9, 0), 0);
}

}  // namespace
}  // namespace truepose
