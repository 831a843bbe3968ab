#include "core/simulation/cell.h"

#include <algorithm>
#include <utility>

#include "core/base/random.h"

namespace truepose {
namespace {

// How much of an event has happened, 0 to 1.
double Share(const CellEvent& event, double t_s) {
  if (t_s < event.at_s) return 0.0;
  return event.over_s > 0.0 ? std::min((t_s - event.at_s) / event.over_s, 1.0) : 1.0;
}

Eigen::Vector3d DrawNormal(double sd, Random* random) {
  const double x = random->Normal(), y = random->Normal(), z = random->Normal();
  return sd * Eigen::Vector3d(x, y, z);
}

SimulateOptions WithoutPoses(SimulateOptions options) {
  options.poses = 0;
  return options;
}

}  // namespace

Cell::Cell(Robot robot, Model model, const Pose& X_FT, const SimulateOptions& options,
           std::vector<CellEvent> events)
    : robot_(std::move(robot)),
      model_(std::move(model)),
      X_FT_(X_FT),
      options_(options),
      events_(std::move(events)) {
  const SimulatedSession drawn = Simulate(robot_, model_, X_FT, WithoutPoses(options));
  lambda_ = drawn.lambda;
  X_MB_ = drawn.X_MB;
}

Eigen::VectorXd Cell::JointShift(double t_s) const {
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(robot_.joint_count());
  for (const CellEvent& event : events_) {
    if (event.joint >= 0) shift(event.joint) += Share(event, t_s) * event.joint_shift;
  }
  return shift;
}

Pose Cell::BaseShift(double t_s) const {
  Pose shift;
  for (const CellEvent& event : events_) {
    const double share = Share(event, t_s);
    shift.p += share * event.base_shift_m;
    shift.R = ExpRotation<double>(share * event.base_turn_rad) * shift.R;
  }
  return shift;
}

Pose Cell::TruePose(const Eigen::VectorXd& q_controller, double t_s) const {
  const Eigen::VectorXd q = robot_.joint_map().ToChain(q_controller + JointShift(t_s));
  return BaseShift(t_s) * Forward(model_, q, lambda_) * X_FT_;
}

Pose Cell::NominalPose(const Eigen::VectorXd& q_controller) const {
  return NominalForward(robot_, q_controller) * X_FT_;
}

Pose Cell::Measure(const Eigen::VectorXd& q_controller, double t_s, uint64_t number) const {
  // Far apart for neighbouring numbers (the golden ratio's bits).
  Random random(options_.seed + (number + 1) * 0x9E3779B97F4A7C15u);
  Pose X_MT = X_MB_ * TruePose(q_controller, t_s);
  X_MT.p += DrawNormal(options_.position_noise_sd_m, &random);
  X_MT.R = ExpRotation<double>(DrawNormal(options_.rotation_noise_sd_rad, &random)) * X_MT.R;
  return X_MT;
}

}  // namespace truepose
