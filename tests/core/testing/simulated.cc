#include "tests/core/testing/simulated.h"

#include <utility>

namespace truepose::testing {

Simulated::Simulated(Robot robot, const Pose& X_FT, const SimulateOptions& options)
    : robot_(std::move(robot)),
      model_(ModifiedIncremental(robot_, ModelExtent::kInternal)),
      session_(Simulate(robot_, model_, X_FT, options)) {}

CalibrationProblem Simulated::Problem(ObservationKind kind, int control_every) const {
  CalibrationProblem problem;
  problem.robot = &robot_;
  problem.placements = problem.targets = {""};
  for (const SimulatedReading& simulated : session_.readings) {
    Reading reading;
    reading.q = robot_.joint_map().ToChain(simulated.q_controller);
    reading.kind = kind;
    reading.X_MT = simulated.X_MT;
    reading.axis_M = simulated.X_MT.R.col(2);
    reading.id = static_cast<int>(problem.readings.size());
    problem.calibrates.push_back(control_every == 0 ||
                                 reading.id % control_every != control_every - 1);
    problem.readings.push_back(reading);
  }
  return problem;
}

Pose AnyTarget() {
  return {ExpRotation<double>({0.4, -1.1, 2.0}), Eigen::Vector3d(0.06, -0.04, 0.15)};
}

}  // namespace truepose::testing
