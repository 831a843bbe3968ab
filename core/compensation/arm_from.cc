#include "core/compensation/arm_from.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/models/chain_parameters.h"

namespace truepose {
namespace {

using compensation::Arm;
using compensation::HarmonicEffect;
using compensation::JointChain;
using compensation::kMaxJoints;
using compensation::kMaxMasses;

// Carries z to the axis; a permutation, so that it costs no digit.
Eigen::Matrix3d FromZ(Axis axis) {
  const int k = static_cast<int>(axis);
  Eigen::Matrix3d Q = Eigen::Matrix3d::Zero();
  Q(k, 2) = Q((k + 1) % 3, 0) = Q((k + 2) % 3, 1) = 1;
  return Q;
}

JointChain JointChainOf(const Chain& chain, const double* mu) {
  JointChain merged;
  Pose X;
  for (const ElementaryTransform& element : chain) {
    const double constant = element.constant + (element.parameter >= 0 ? mu[element.parameter] : 0);
    Apply(element.motion, element.axis, constant, &X);
    if (element.joint < 0) continue;
    const Eigen::Matrix3d Q = FromZ(element.axis);
    merged.prismatic[merged.joints] = element.motion == Motion::kTranslation;
    merged.constant[merged.joints++] = {X.R * Q, X.p};
    X = {Q.transpose(), Eigen::Vector3d::Zero()};
  }
  merged.constant[merged.joints] = X;
  return merged;
}

void AddEffect(const JointEffect& effect, double value, HarmonicEffect* sum) {
  switch (effect.kind) {
    case EffectKind::kGain:
      sum->gain += value;
      return;
    case EffectKind::kCosine:
      sum->cosine[effect.harmonic - 1] += value;
      return;
    case EffectKind::kSine:
      sum->sine[effect.harmonic - 1] += value;
      return;
    case EffectKind::kTorque:
      sum->compliance += value;
      return;
    case EffectKind::kTemperature:
      return;  // none at the reference
  }
}

absl::Status Check(const Robot& robot, const Model& model, const Eigen::VectorXd& lambda) {
  FaultList faults;
  if (robot.joint_count() > kMaxJoints)
    faults.Add("robot.joints", absl::StrCat(robot.joint_count()),
               absl::StrCat("at most ", kMaxJoints));
  if (model.masses.size() > static_cast<size_t>(kMaxMasses))
    faults.Add("robot.masses", absl::StrCat(model.masses.size()),
               absl::StrCat("at most ", kMaxMasses));
  if (lambda.size() != model.parameters.size() || !lambda.allFinite())
    faults.Add("lambda", absl::StrCat(lambda.size(), " values"),
               absl::StrCat(model.parameters.size(), " finite values"));
  return faults.ToStatus();
}

void SetJoints(const Robot& robot, Arm* arm) {
  const int n = robot.joint_count();
  arm->joint_scale.topLeftCorner(n, n) = robot.joint_map().scale;
  arm->joint_offset.head(n) = robot.joint_map().offset;
  for (int i = 0; i < n; ++i) arm->limits[i] = {robot.joints()[i].lower, robot.joints()[i].upper};
}

void SetEffects(const Model& model, const Eigen::VectorXd& lambda, Arm* arm) {
  for (const JointEffect& effect : model.effects)
    AddEffect(effect, lambda(effect.parameter), &arm->effects[effect.joint]);
  for (const LinkMass& mass : model.masses)
    arm->mass[arm->masses++] = {mass.joint, mass.mass_kg, mass.centre_B};
}

}  // namespace

absl::StatusOr<Arm> ArmFrom(const Robot& robot, const Model& model, const Eigen::VectorXd& lambda) {
  TRUEPOSE_RETURN_IF_ERROR(Check(robot, model, lambda));
  Arm arm;
  // The model's chain at zero, and not the robot's, which equals it but for the last bits: so
  // values of zero correct nothing at all.
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(lambda.size());
  arm.nominal = JointChainOf(model.chain, ChainParametersOf(model, zero).data());
  arm.identified = JointChainOf(model.chain, ChainParametersOf(model, lambda).data());
  SetJoints(robot, &arm);
  SetEffects(model, lambda, &arm);
  return arm;
}

}  // namespace truepose
