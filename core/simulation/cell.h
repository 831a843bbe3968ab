// A robot in front of an instrument, both with a known truth that changes with time: what drift and
// recalibration are tried out on.
//
//   X_MT(q, t) = X_MB X_BB'(t) X_BF(q + dq(t), lambda) X_FT
//
// with errors lambda, X_MB drawn as in simulate.h, and what events did to the base (X_BB') and to
// controller joints (dq) until t.
#pragma once

#include <cstdint>
#include <vector>

#include "core/simulation/simulate.h"

namespace truepose {

// Something that happens to the robot, at once or slowly. Several add up.
struct CellEvent {
  double at_s = 0;    // from then on
  double over_s = 0;  // 0 = a bump; else a drift that grows evenly for so long
  // The robot's base against where it stood, in B.
  Eigen::Vector3d base_shift_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d base_turn_rad = Eigen::Vector3d::Zero();  // rotation vector
  // Controller joint from 0, -1 = none: it really stands at q + shift when it reads q.
  int joint = -1;
  double joint_shift = 0;  // rad or m
};

class Cell {
 public:
  // @param model of extent kInternal. `options.poses`, joint range, joint noise and resolution are
  // not used. @pre events name joints of the robot.
  Cell(Robot robot, Model model, const Pose& X_FT, const SimulateOptions& options,
       std::vector<CellEvent> events = {});

  // The tool in B as it stood at time 0, at controller joints q.
  Pose TruePose(const Eigen::VectorXd& q_controller, double t_s) const;
  // The same by nominal parameters and without events: what the controller believes.
  Pose NominalPose(const Eigen::VectorXd& q_controller) const;

  // X_MT as measured. Its noise depends on the seed and the number alone: the same reading again is
  // the same reading.
  Pose Measure(const Eigen::VectorXd& q_controller, double t_s, uint64_t number) const;

  const Robot& robot() const { return robot_; }
  const Eigen::VectorXd& lambda() const { return lambda_; }
  const Pose& X_MB() const { return X_MB_; }

 private:
  Eigen::VectorXd JointShift(double t_s) const;
  Pose BaseShift(double t_s) const;

  const Robot robot_;
  const Model model_;
  const Pose X_FT_;
  const SimulateOptions options_;
  const std::vector<CellEvent> events_;
  Eigen::VectorXd lambda_;
  Pose X_MB_;
};

}  // namespace truepose
