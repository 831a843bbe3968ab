#include "core/simulation/simulate.h"

#include <gtest/gtest.h>

#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

SimulatedSession Session(const SimulateOptions& options) {
  const Robot robot = testing::Stanford();
  return Simulate(robot, ModifiedIncremental(robot, ModelExtent::kInternal), Pose{}, options);
}

// The same seed is the same session; another noise leaves the robot and its poses as they are drawn
// first.
TEST(Simulate, SeedDecides) {
  SimulateOptions options;
  options.poses = 5;
  const SimulatedSession a = Session(options), b = Session(options);
  EXPECT_EQ(a.lambda, b.lambda);
  EXPECT_EQ(a.readings[4].X_MT.p, b.readings[4].X_MT.p);
  options.position_noise_sd_m = 1;
  EXPECT_EQ(Session(options).lambda, a.lambda);
  options.seed = 2;
  EXPECT_NE(Session(options).lambda, a.lambda);
}

// Readings are multiples of the resolution, and the pose is that of the joints before rounding.
TEST(Simulate, EncoderResolution) {
  SimulateOptions options;
  options.poses = 20;
  options.encoder_resolution = 3e-4;
  for (const SimulatedReading& reading : Session(options).readings) {
    for (double q : reading.q_controller) EXPECT_NEAR(std::remainder(q, 3e-4), 0, 1e-12);
  }
  options.encoder_resolution = 0;
  const SimulatedSession fine = Session(options);
  options.encoder_resolution = 3e-4;
  const SimulatedSession coarse = Session(options);
  EXPECT_EQ(fine.readings[0].X_MT.p, coarse.readings[0].X_MT.p);
  EXPECT_LE((fine.readings[0].q_controller - coarse.readings[0].q_controller).cwiseAbs().maxCoeff(),
            1.5e-4 + 1e-12);
}

// Joints stay in range and limits; errors have the stated size.
TEST(Simulate, JointsAndErrors) {
  SimulateOptions options;
  options.poses = 200;
  options.joint_range_rad = 0.4;
  options.prismatic_range_m = 0.1;
  options.length_error_sd_m = 0;
  options.angle_error_sd_rad = 1e-3;
  const SimulatedSession session = Session(options);
  for (const SimulatedReading& reading : session.readings) {
    for (int i = 0; i < 6; ++i) EXPECT_LE(std::abs(reading.q_controller(i)), i == 2 ? 0.1 : 0.4);
  }
  const Model model = ModifiedIncremental(testing::Stanford(), ModelExtent::kInternal);
  for (int i = 0; i < model.parameters.size(); ++i) {
    if (model.parameters[i].is_angle()) {
      EXPECT_NE(session.lambda(i), 0);
      EXPECT_LT(std::abs(session.lambda(i)), 5e-3);
    } else if (model.parameters[i].role == ParameterRole::kLength) {
      EXPECT_EQ(session.lambda(i), 0);
    }
  }
}

}  // namespace
}  // namespace truepose
