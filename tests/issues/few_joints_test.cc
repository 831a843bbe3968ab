// Symptom: a session in which only two parallel joints move ended with "tool.z: found not
// determined ... motion of base and of tool frame". A shift of the target along parallel axes is
// one of the base: the robot does not depend on it, and its other parameters can be found.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/calibrate/calibrate.h"
#include "core/identification/identifiability.h"
#include "tests/core/testing/robots.h"
#include "tests/core/testing/simulated.h"

namespace truepose {
namespace {

using testing::Simulated;

SimulateOptions Session() {
  SimulateOptions options;
  options.poses = 60;
  options.seed = 9;
  return options;
}

// The session's readings with all joints but `moving` as in the first; noise of 20 um a coordinate.
CalibrationProblem OnlyMoving(const Simulated& simulated, const std::set<int>& moving) {
  CalibrationProblem problem = simulated.Problem();
  Random random(4);
  for (Reading& reading : problem.readings) {
    for (int j = 0; j < reading.q.size(); ++j)
      if (!moving.contains(j + 1)) reading.q(j) = problem.readings[0].q(j);
    reading.X_MT = simulated.session().X_MB *
                   Forward(simulated.model(), reading.q, simulated.session().lambda) *
                   simulated.session().X_FT;
    for (double& coordinate : reading.X_MT.p) coordinate += 2e-5 * random.Normal();
  }
  return problem;
}

std::vector<std::string> DroppedOfFrames(const CalibrationResult& result) {
  std::vector<std::string> names;
  for (const NullRelation& relation : result.identification.set.redundancies) {
    const Parameter& parameter = result.candidates[relation.dropped];
    if (parameter.group != ParameterGroup::kInternal) names.push_back(parameter.name);
  }
  return names;
}

bool Finds(const CalibrationResult& result, const std::string& name) {
  const std::vector<int>& active = result.identification.set.active;
  return std::any_of(active.begin(), active.end(),
                     [&](int index) { return result.candidates[index].name == name; });
}

// What was not identified is exactly nominal.
void ExpectTheRestIsNominal(const CalibrationResult& result) {
  for (int i = 0; i < result.model.parameters.size(); ++i) {
    if (Finds(result, result.model.parameters[i].name)) continue;
    EXPECT_EQ(result.identification.estimate.lambda(i), 0) << result.model.parameters[i].name;
  }
}

class ParallelJoints : public ::testing::TestWithParam<std::set<int>> {};

// One direction of the tool is named as dropped, none of the base; what the joints show is found,
// and nobody is told to apply it everywhere.
TEST_P(ParallelJoints, AreCalibrated) {
  const Simulated simulated(testing::Ur10(), testing::AnyTarget(), Session());
  const auto result = Calibrate(OnlyMoving(simulated, GetParam()), {}, {});
  ASSERT_TRUE(result.ok()) << result.status();
  const std::vector<std::string> dropped = DroppedOfFrames(*result);
  ASSERT_FALSE(dropped.empty());
  for (const std::string& name : dropped) EXPECT_EQ(name.rfind("tool.", 0), 0u) << name;
  EXPECT_NE(result->verdict.decision, Decision::kApply);
  ExpectTheRestIsNominal(*result);
  // Noise of 20 um on each axis is 35 um of position; twice that would be a model that is wrong.
  EXPECT_LT(PoseStatisticsOf(result->control.after).position_m.rms, 7e-5);
}

INSTANTIATE_TEST_SUITE_P(Ur10, ParallelJoints,
                         ::testing::Values(std::set<int>{2, 4}, std::set<int>{2, 3},
                                           std::set<int>{3}));

// The same with a prior, under which nothing is called too weak.
TEST(ParallelJoints, AreCalibratedWithAPrior) {
  const Simulated simulated(testing::Ur10(), testing::AnyTarget(), Session());
  CalibrateOptions options;
  options.prior = PriorKind::kTolerance;
  const auto result = Calibrate(OnlyMoving(simulated, {2, 4}), options, {});
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(DroppedOfFrames(*result).size(), 1u);
}

// Joints that are not parallel determine base and tool: the tolerance must not swallow a direction
// that readings show.
TEST(CrossedJoints, DropNoDirection) {
  const Simulated simulated(testing::Ur10(), testing::AnyTarget(), Session());
  const auto result = Calibrate(OnlyMoving(simulated, {3, 5}), {}, {});
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_TRUE(DroppedOfFrames(*result).empty());
}

}  // namespace
}  // namespace truepose
