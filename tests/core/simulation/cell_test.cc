#include "core/simulation/cell.h"

#include <gtest/gtest.h>

#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

Cell Make(std::vector<CellEvent> events, SimulateOptions options = {}) {
  const Robot robot = testing::Stanford();
  return Cell(robot, ModifiedIncremental(robot, ModelExtent::kInternal), Pose{}, options,
              std::move(events));
}

Eigen::VectorXd Joints() { return Make({}).robot().MiddleOfLimits().array() + 0.1; }

SimulateOptions Exact() {
  SimulateOptions options;
  options.position_noise_sd_m = options.rotation_noise_sd_rad = 0;
  return options;
}

// Would catch a truth that is not the one that was drawn.
TEST(Cell, MeasuresWhatSimulateMeasures) {
  const SimulateOptions options = Exact();
  const Robot robot = testing::Stanford();
  const SimulatedSession session =
      Simulate(robot, ModifiedIncremental(robot, ModelExtent::kInternal), Pose{}, options);
  const Cell cell = Make({}, options);
  EXPECT_EQ(cell.lambda(), session.lambda);
  for (const SimulatedReading& reading : session.readings) {
    const Pose X_MT = cell.Measure(reading.q_controller, 0, 1);
    EXPECT_EQ(X_MT.p, reading.X_MT.p);
    EXPECT_EQ(X_MT.R, reading.X_MT.R);
  }
}

// Would catch an event before its time, and a base that is moved in another frame.
TEST(Cell, ABumpOfTheBaseMovesTheTool) {
  CellEvent bump{.at_s = 10};
  bump.base_shift_m = Eigen::Vector3d(0.0003, 0, -0.0004);
  const Cell cell = Make({bump});
  const Pose before = cell.TruePose(Joints(), 9.999), after = cell.TruePose(Joints(), 10);
  EXPECT_TRUE((after.p - before.p).isApprox(bump.base_shift_m, 1e-9));
  EXPECT_TRUE(after.R.isApprox(before.R, 1e-15));
}

// Would catch a joint that is moved twice or in the wrong direction: it stands where another
// reading would have been.
TEST(Cell, ABumpOfAJointIsAnotherReading) {
  CellEvent bump{.at_s = 10};
  bump.joint = 2;
  bump.joint_shift = 3e-4;
  const Cell cell = Make({bump});
  Eigen::VectorXd moved = Joints();
  moved(2) += 3e-4;
  EXPECT_TRUE(cell.TruePose(Joints(), 11).p.isApprox(cell.TruePose(moved, 0).p, 1e-12));
}

// Half the time is half the drift; after its end nothing more comes; two events add up.
TEST(Cell, DriftsGrowEvenly) {
  CellEvent drift{.at_s = 100, .over_s = 50};
  drift.base_shift_m = Eigen::Vector3d(0.001, 0, 0);
  CellEvent bump = drift;
  bump.over_s = 0;
  bump.at_s = 1000;
  const Cell cell = Make({drift, bump});
  const auto moved = [&](double t_s) {
    return (cell.TruePose(Joints(), t_s).p - cell.TruePose(Joints(), 0).p).x();
  };
  // Differences of lengths around 1 m.
  EXPECT_NEAR(moved(125), 0.0005, 1e-12);
  EXPECT_NEAR(moved(150), 0.001, 1e-12);
  EXPECT_NEAR(moved(999), 0.001, 1e-12);
  EXPECT_NEAR(moved(1000), 0.002, 1e-12);
}

// Would catch noise that depends on what was asked before, which no restarted source could repeat.
TEST(Cell, NoiseBelongsToTheNumber) {
  const Cell a = Make({}), b = Make({});
  a.Measure(Joints(), 0, 1);
  EXPECT_EQ(a.Measure(Joints(), 0, 7).p, b.Measure(Joints(), 0, 7).p);
  EXPECT_NE(a.Measure(Joints(), 0, 7).p, a.Measure(Joints(), 0, 8).p);
}

// Its size, over 2,000 readings: the estimate of a deviation scatters by 1/sqrt(2*6000) = 0.9 %.
TEST(Cell, NoiseHasItsSize) {
  SimulateOptions options;
  options.position_noise_sd_m = 1e-4;
  const Cell cell = Make({}, options);
  const Pose truth = cell.X_MB() * cell.TruePose(Joints(), 0);
  double sum = 0;
  for (uint64_t i = 0; i < 2000; ++i)
    sum += (cell.Measure(Joints(), 0, i).p - truth.p).squaredNorm();
  EXPECT_NEAR(std::sqrt(sum / 6000), 1e-4, 4e-6);
}

}  // namespace
}  // namespace truepose
