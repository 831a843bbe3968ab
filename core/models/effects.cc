#include "core/models/effects.h"

#include <cmath>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/models/model.h"

namespace truepose {
namespace {

Unit PerUnit(JointType type, Unit of_revolute, Unit of_prismatic) {
  return type == JointType::kRevolute ? of_revolute : of_prismatic;
}

void Add(const std::string& stem, EffectKind kind, int joint, int harmonic, Unit unit,
         Model* model) {
  const int parameter = model->parameters.Add(
      {absl::StrCat(stem, joint + 1), ParameterGroup::kInternal, ParameterRole::kEffect, unit});
  model->effects.push_back({kind, joint, harmonic, parameter});
}

void AddHarmonic(int joint, int harmonic, Model* model) {
  const std::string stem = absl::StrCat("harmonic", harmonic, "_");
  Add(stem + "cos", EffectKind::kCosine, joint, harmonic, Unit::kRadian, model);
  Add(stem + "sin", EffectKind::kSine, joint, harmonic, Unit::kRadian, model);
}

}  // namespace

const char* Name(EffectGroup group) {
  switch (group) {
    case EffectGroup::kGain:
      return "gain";
    case EffectGroup::kHarmonic1:
      return "harmonic1";
    case EffectGroup::kHarmonic2:
      return "harmonic2";
    case EffectGroup::kCompliance:
      return "compliance";
    case EffectGroup::kTemperature:
      break;
  }
  return "temperature";
}

const std::vector<EffectGroup>& AllEffectGroups() {
  static const std::vector<EffectGroup> groups = {EffectGroup::kGain, EffectGroup::kHarmonic1,
                                                  EffectGroup::kHarmonic2, EffectGroup::kCompliance,
                                                  EffectGroup::kTemperature};
  return groups;
}

void AddEffects(const Robot& robot, EffectGroup group, Model* model) {
  if (group == EffectGroup::kCompliance) {
    model->nominal_chain = robot.chain();
    model->masses = robot.masses();
  }
  for (int j = 0; j < robot.joint_count(); ++j) {
    const JointType type = robot.joints()[j].type;
    const bool revolute = type == JointType::kRevolute;
    if (group == EffectGroup::kGain) Add("gain", EffectKind::kGain, j, 1, Unit::kRatio, model);
    if (group == EffectGroup::kHarmonic1 && revolute) AddHarmonic(j, 1, model);
    if (group == EffectGroup::kHarmonic2 && revolute) AddHarmonic(j, 2, model);
    if (group == EffectGroup::kCompliance)
      Add("compliance", EffectKind::kTorque, j, 1,
          PerUnit(type, Unit::kRadianPerNewtonMetre, Unit::kMetrePerNewton), model);
    if (group == EffectGroup::kTemperature)
      Add("temperature", EffectKind::kTemperature, j, 1,
          PerUnit(type, Unit::kRadianPerKelvin, Unit::kMetrePerKelvin), model);
  }
}

Eigen::VectorXd TorqueOf(const Model& model, const Eigen::VectorXd& q_chain,
                         const Conditions& conditions) {
  if (conditions.joint_torque.size() > 0 || model.masses.empty()) return conditions.joint_torque;
  return model.joint_map.scale.transpose() *
         GravityLoad(model.nominal_chain, model.masses, q_chain);
}

double Regressor(const JointEffect& effect, double q_j, const Conditions& conditions) {
  switch (effect.kind) {
    case EffectKind::kGain:
      return q_j;
    case EffectKind::kCosine:
      return std::cos(effect.harmonic * q_j);
    case EffectKind::kSine:
      return std::sin(effect.harmonic * q_j);
    case EffectKind::kTorque:
      return effect.joint < conditions.joint_torque.size() ? conditions.joint_torque(effect.joint)
                                                           : 0;
    case EffectKind::kTemperature:
      break;
  }
  return conditions.temperature_K;
}

}  // namespace truepose
