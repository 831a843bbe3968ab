// Calibration problems of simulated robots.
#pragma once

#include "core/calibrate/calibrate.h"
#include "core/simulation/simulate.h"

namespace truepose::testing {

// A robot with its model and a simulated session of it; keeps what the problem points to.
class Simulated {
 public:
  Simulated(Robot robot, const Pose& X_FT, const SimulateOptions& options);

  // All readings, one placement and target, every `control_every`-th row control (0: none).
  CalibrationProblem Problem(ObservationKind kind = ObservationKind::kPose,
                             int control_every = 2) const;

  const Robot& robot() const { return robot_; }
  const Model& model() const { return model_; }
  const SimulatedSession& session() const { return session_; }

 private:
  Robot robot_;
  Model model_;
  SimulatedSession session_;
};

// A target askew and off the last axis.
Pose AnyTarget();

}  // namespace truepose::testing
