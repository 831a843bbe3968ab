#include "core/models/model.h"

#include <cmath>

#include "core/models/chain_parameters.h"

namespace truepose {
namespace {

// How alpha, beta and gamma of a tilt follow from theta_x and theta_y.
struct TiltAngles {
  double alpha, beta, gamma;
  Eigen::Matrix<double, 3, 2> J;  // (alpha, beta, gamma) by (theta_x, theta_y)
};

// d atan2(a, b) = (b da - a db) / (a^2 + b^2).
Eigen::RowVector2d AtanGradient(double a, const Eigen::RowVector2d& da, double b,
                                const Eigen::RowVector2d& db) {
  return (b * da - a * db) / (a * a + b * b);
}

TiltAngles AnglesOf(double x, double y) {
  const double z = std::sqrt(1 - x * x - y * y);
  const Eigen::RowVector2d dz(-x / z, -y / z);
  const double a = x * y, b = 1 + z - x * x;
  TiltAngles angles;
  angles.alpha = std::atan2(-y, z);
  angles.beta = std::asin(x);
  angles.gamma = std::atan2(a, b);
  angles.J.row(0) = AtanGradient(-y, {0, -1}, z, dz);
  angles.J.row(1) << 1 / std::sqrt(1 - x * x), 0;
  angles.J.row(2) = AtanGradient(a, {y, x}, b, Eigen::RowVector2d(dz(0) - 2 * x, dz(1)));
  return angles;
}

// The chain's parameters of the model's.
const double* ChainParameters(const Model& model, const double* lambda, Eigen::VectorXd* mu) {
  if (model.tilts.empty()) return lambda;
  mu->resize(ParameterCount(model.chain));
  for (Eigen::Index i = 0; i < mu->size() && i < model.parameters.size(); ++i) (*mu)(i) = lambda[i];
  for (const Tilt& tilt : model.tilts) {
    const TiltAngles angles = AnglesOf(lambda[tilt.theta_x], lambda[tilt.theta_y]);
    (*mu)(tilt.theta_x) = angles.beta;
    (*mu)(tilt.theta_y) = angles.alpha;
    (*mu)(tilt.gamma) = angles.gamma;
  }
  return mu->data();
}

Eigen::VectorXd ControllerJoints(const Model& model, const double* q) {
  return model.joint_map.ToController(
      Eigen::Map<const Eigen::VectorXd>(q, model.joint_map.offset.size()));
}

// What the effects are functions of.
struct EffectInputs {
  Eigen::VectorXd q_controller;
  Conditions conditions;
};

EffectInputs InputsOf(const Model& model, const double* q, const Conditions& conditions) {
  EffectInputs inputs{ControllerJoints(model, q), conditions};
  if (!model.masses.empty()) {
    const Eigen::VectorXd q_chain =
        Eigen::Map<const Eigen::VectorXd>(q, model.joint_map.offset.size());
    inputs.conditions.joint_torque = TorqueOf(model, q_chain, conditions);
  }
  return inputs;
}

// Chain joints as moved by the effects.
const double* MovedJoints(const Model& model, const double* q, const double* lambda,
                          const Conditions& conditions, Eigen::VectorXd* moved) {
  if (model.effects.empty()) return q;
  const auto [q_controller, given] = InputsOf(model, q, conditions);
  *moved = Eigen::Map<const Eigen::VectorXd>(q, q_controller.size());
  for (const JointEffect& effect : model.effects) {
    const double shift =
        lambda[effect.parameter] * Regressor(effect, q_controller(effect.joint), given);
    *moved += model.joint_map.scale.col(effect.joint) * shift;
  }
  return moved->data();
}

void TiltColumns(const Model& model, const double* lambda, const Sweep& chain, ModelSweep* sweep) {
  for (const Tilt& tilt : model.tilts) {
    const TiltAngles angles = AnglesOf(lambda[tilt.theta_x], lambda[tilt.theta_y]);
    Eigen::Matrix<double, 6, 3> columns;
    columns << chain.J_parameters.col(tilt.theta_y), chain.J_parameters.col(tilt.theta_x),
        chain.J_parameters.col(tilt.gamma);
    sweep->J_parameters.col(tilt.theta_x) = columns * angles.J.col(0);
    sweep->J_parameters.col(tilt.theta_y) = columns * angles.J.col(1);
  }
}

void EffectColumns(const Model& model, const double* q, const Conditions& conditions,
                   ModelSweep* sweep) {
  const auto [q_controller, given] = InputsOf(model, q, conditions);
  for (const JointEffect& effect : model.effects) {
    sweep->J_parameters.col(effect.parameter) =
        sweep->chain.J_joints * model.joint_map.scale.col(effect.joint) *
        Regressor(effect, q_controller(effect.joint), given);
  }
}

}  // namespace

Eigen::VectorXd EffectShift(const Model& model, const Eigen::VectorXd& q,
                            const Eigen::VectorXd& lambda, const Conditions& conditions) {
  Eigen::VectorXd moved = q;
  MovedJoints(model, q.data(), lambda.data(), conditions, &moved);
  return moved - q;
}

Eigen::VectorXd ChainParametersOf(const Model& model, const Eigen::VectorXd& lambda) {
  Eigen::VectorXd mu;
  const double* values = ChainParameters(model, lambda.data(), &mu);
  return Eigen::Map<const Eigen::VectorXd>(values, ParameterCount(model.chain));
}

Pose Forward(const Model& model, const Eigen::VectorXd& q, const Eigen::VectorXd& lambda,
             const Conditions& conditions) {
  Eigen::VectorXd moved, mu;
  return Forward<double>(model.chain,
                         MovedJoints(model, q.data(), lambda.data(), conditions, &moved),
                         ChainParameters(model, lambda.data(), &mu));
}

void RunSweep(const Model& model, const double* q, const double* lambda,
              const Conditions& conditions, ModelSweep* sweep) {
  RunSweep(model.chain, MovedJoints(model, q, lambda, conditions, &sweep->q),
           ChainParameters(model, lambda, &sweep->mu), &sweep->chain);
  sweep->X_BF = sweep->chain.X_0E;
  sweep->J_joints = sweep->chain.J_joints;
  if (model.tilts.empty() && model.effects.empty()) {
    std::swap(sweep->J_parameters, sweep->chain.J_parameters);
    return;
  }
  const Eigen::Index geometric =
      model.parameters.size() - static_cast<Eigen::Index>(model.effects.size());
  sweep->J_parameters.setZero(6, model.parameters.size());
  sweep->J_parameters.leftCols(geometric) = sweep->chain.J_parameters.leftCols(geometric);
  TiltColumns(model, lambda, sweep->chain, sweep);
  if (!model.effects.empty()) EffectColumns(model, q, conditions, sweep);
}

}  // namespace truepose
