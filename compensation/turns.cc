#include "compensation/turns.h"

#include <cmath>
#include <numbers>

namespace truepose::compensation {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double NearestTurn(double q, double reference) {
  return q - kTurn * std::round((q - reference) / kTurn);
}

bool IsWithin(const JointLimits& limits, double q) {
  return q >= limits.lower && q <= limits.upper;
}

}  // namespace

bool WholeTurnIsNoMotion(const Arm& arm, int joint) noexcept {
  if (arm.nominal.prismatic[joint]) return false;
  for (int row = 0; row < arm.nominal.joints; ++row) {
    const double scale = arm.joint_scale(row, joint);
    if (arm.nominal.prismatic[row] ? scale != 0 : scale != std::round(scale)) return false;
  }
  return true;
}

int Unwind(const Arm& arm, const double* q_reference, double* q) noexcept {
  int beyond = -1;
  for (int i = 0; i < arm.nominal.joints; ++i) {
    const JointLimits& limits = arm.limits[i];
    if (WholeTurnIsNoMotion(arm, i)) {
      q[i] = NearestTurn(q[i], q_reference[i]);
      // From beyond a limit only turns back towards it can help: the first within is the nearest.
      if (q[i] > limits.upper)
        q[i] -= kTurn * std::ceil((q[i] - limits.upper) / kTurn);
      else if (q[i] < limits.lower)
        q[i] += kTurn * std::ceil((limits.lower - q[i]) / kTurn);
    }
    if (beyond < 0 && !IsWithin(limits, q[i])) beyond = i;
  }
  return beyond;
}

void UnwindChain(const JointChain& chain, const double* q_reference, double* q_chain) noexcept {
  for (int i = 0; i < chain.joints; ++i) {
    if (!chain.prismatic[i]) q_chain[i] = NearestTurn(q_chain[i], q_reference[i]);
  }
}

}  // namespace truepose::compensation
