// Joint effects: what moves a joint beside its reading, with parameters of its own.
//
// Controller joint j of reading q moves by an extra sum_k lambda_k phi_k, so the chain's joints are
//   q_chain = S (q + sum_k lambda_k phi_k(q_j, conditions) e_j) + offset
// (S, offset: the robot's joint map), and the pose moves with lambda_k as S e_j phi_k through the
// chain's joint Jacobian. phi_k by kind:
//   gain         q_j                  ratio
//   cosine k     cos(k q_j)           rad or m; k = 1, 2: gear harmonics
//   sine k       sin(k q_j)
//   torque       torque of joint j    rad / (N m) or m / N: compliance; measured, or of gravity
//   temperature  temperature_K        rad / K or m / K: drift of the zero
// Prismatic joints have no harmonics.
#pragma once

#include <string_view>
#include <vector>

#include "core/robot/conditions.h"
#include "core/robot/robot.h"

namespace truepose {

struct Model;

enum class EffectKind { kGain, kCosine, kSine, kTorque, kTemperature };

struct JointEffect {
  EffectKind kind = EffectKind::kGain;
  int joint = 0;      // controller joint
  int harmonic = 1;   // of kCosine and kSine
  int parameter = 0;  // index into the model's parameters
};

// The groups that are chosen together.
enum class EffectGroup { kGain, kHarmonic1, kHarmonic2, kCompliance, kTemperature };

// "gain", "harmonic1", "harmonic2", "compliance", "temperature".
const char* Name(EffectGroup group);
const std::vector<EffectGroup>& AllEffectGroups();

// Appends the group's effects of every joint: gain3; harmonic1_cos3, harmonic1_sin3; compliance3;
// temperature3. A group is added at most once to a model.
void AddEffects(const Robot& robot, EffectGroup group, Model* model);

// Torques of the controller joints: as measured, else those of gravity on the model's masses; empty
// where neither is known.
Eigen::VectorXd TorqueOf(const Model& model, const Eigen::VectorXd& q_chain,
                         const Conditions& conditions);

// phi of one effect at controller joint value q_j.
double Regressor(const JointEffect& effect, double q_j, const Conditions& conditions);

}  // namespace truepose
