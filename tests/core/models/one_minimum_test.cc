// All models describe the same robots, so a session has one least cost, whatever the model. Would
// catch a model that lacks a direction away from nominal, or whose start is in another minimum.
#include <gtest/gtest.h>

#include "core/identification/identify.h"
#include "tests/core/testing/models.h"
#include "tests/core/testing/simulated.h"

namespace truepose {
namespace {

// Noise of 0.05 mm and 0.1 mrad on errors of 0.5 mm and 0.5 mrad.
double LeastCost(const Robot& robot, const std::vector<Reading>& readings, const Model& model) {
  const Problem problem{&model, readings, {""}, {""}};
  const auto start = FindStart(problem, {}, {});
  EXPECT_TRUE(start.ok()) << start.status();
  Estimate estimate = *start;
  const std::vector<int> active = GenericIdentifiable(problem, robot).active;
  const SolveSummary summary = Solve(problem, {5e-5, 1e-4}, active, {}, {}, &estimate);
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  return summary.final_cost;
}

// The models agree up to what the kept set at nominal leaves of second order: nothing, since each
// set has as many parameters as the robots have. 1e-6 is the solver's own: it stops where a step
// gains less than 1e-14 of the cost, a hundred steps from the end at worst.
TEST(OneMinimum, OfAllModels) {
  for (const Robot& robot : {testing::Ur10(), testing::Stanford(), testing::Panda()}) {
    SimulateOptions options;
    options.poses = 60;
    const testing::Simulated simulated(robot, testing::AnyTarget(), options);
    const std::vector<Reading> readings = simulated.Problem().readings;
    const double least = LeastCost(
        robot, readings, testing::ModelOf("modified_incremental", robot, ModelExtent::kInternal));
    for (const std::string& kind : ModelKinds()) {
      SCOPED_TRACE(kind);
      const Model model = testing::ModelOf(kind, robot, ModelExtent::kInternal);
      EXPECT_NEAR(LeastCost(robot, readings, model), least, 1e-6 * least);
    }
  }
}

}  // namespace
}  // namespace truepose
