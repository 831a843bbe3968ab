#include "compensation/effects.h"

#include <algorithm>
#include <cmath>

#include "compensation/kinematics.h"

namespace truepose::compensation {
namespace {

constexpr double kGravity = 9.80665;  // m / s^2, standard
constexpr int kMostPasses = 50;
constexpr double kSettled = 4e-15;  // rad or m: the last bits of a joint and of its effects

bool HasCompliance(const Arm& arm) {
  for (int i = 0; i < arm.nominal.joints; ++i) {
    if (arm.effects[i].compliance != 0) return arm.masses > 0;
  }
  return false;
}

double ShiftOf(const HarmonicEffect& effect, bool prismatic, double q) {
  double shift = effect.gain * q;
  if (prismatic) return shift;
  const double c = std::cos(q), s = std::sin(q);
  shift += effect.cosine[0] * c + effect.sine[0] * s;
  return shift + effect.cosine[1] * (c * c - s * s) + effect.sine[1] * (2 * s * c);
}

// -dU/dq of one mass: its weight times how fast each joint lifts it.
void AddLoad(const JointChain& chain, const Sweep& sweep, const Eigen::Vector3d& p,
             const PointMass& mass, double* load) {
  for (int i = 0; i <= mass.joint; ++i) {
    const JointAxis& axis = sweep.axis[i];
    const double lift = chain.prismatic[i] ? axis.u.z() : axis.u.cross(p - axis.p).z();
    load[i] -= mass.mass_kg * kGravity * lift;
  }
}

}  // namespace

bool HasEffects(const Arm& arm) noexcept {
  double sum = 0;
  for (int i = 0; i < arm.nominal.joints; ++i) {
    const HarmonicEffect& effect = arm.effects[i];
    sum += std::abs(effect.gain) + std::abs(effect.compliance);
    for (int k = 0; k < 2; ++k) sum += std::abs(effect.cosine[k]) + std::abs(effect.sine[k]);
  }
  return sum != 0;
}

void GravityLoads(const Arm& arm, const double* q_controller, double* load) noexcept {
  const JointChain& chain = arm.nominal;
  JointArray q_chain, of_chain{};
  ToChain(arm, q_controller, q_chain.data());
  Motions motions;
  SetMotions(chain, q_chain.data(), &motions);
  Sweep sweep;
  RunSweep(chain, motions, &sweep);
  Motions at_zero;
  SetMotions(chain, JointArray{}.data(), &at_zero);
  for (int k = 0; k < arm.masses; ++k) {
    const PointMass& mass = arm.mass[k];
    const Pose home = AfterMotion(chain, at_zero, mass.joint);
    const Pose now = AfterMotion(chain, motions, mass.joint);
    AddLoad(chain, sweep, now * (Inverse(home) * mass.centre_B), mass, of_chain.data());
  }
  for (int j = 0; j < chain.joints; ++j) {
    load[j] = 0;
    for (int i = 0; i < chain.joints; ++i) load[j] += arm.joint_scale(i, j) * of_chain[i];
  }
}

void MovedJoints(const Arm& arm, const double* q_controller, double* moved) noexcept {
  const int n = arm.nominal.joints;
  std::copy_n(q_controller, n, moved);
  if (!HasEffects(arm)) return;
  JointArray load{};
  if (HasCompliance(arm)) GravityLoads(arm, q_controller, load.data());
  for (int i = 0; i < n; ++i) {
    moved[i] += ShiftOf(arm.effects[i], arm.nominal.prismatic[i], q_controller[i]) +
                arm.effects[i].compliance * load[i];
  }
}

bool ReadingsOf(const Arm& arm, const double* moved, double* q_controller) noexcept {
  const int n = arm.nominal.joints;
  std::copy_n(moved, n, q_controller);
  if (!HasEffects(arm)) return true;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    JointArray now;
    MovedJoints(arm, q_controller, now.data());
    double worst = 0;
    for (int i = 0; i < n; ++i) {
      const double missing = moved[i] - now[i];
      q_controller[i] += missing;
      worst = std::max(worst, std::abs(missing) / (1 + std::abs(moved[i])));
    }
    if (worst <= kSettled) return true;
    if (!(worst < 1e3)) return false;
  }
  return false;
}

}  // namespace truepose::compensation
