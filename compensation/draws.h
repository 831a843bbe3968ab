// Starts for damped Newton: seeded, the same on every machine.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "compensation/arm.h"

namespace truepose::compensation {

class Draws {
 public:
  explicit Draws(std::uint64_t seed) noexcept : state_(seed) {}

  // Uniform over [0, 1).
  double Next() noexcept {
    state_ += 0x9E3779B97F4A7C15u;  // Weyl sequence, then a mix of its bits
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

  // Controller joints uniform over their limits, at most half a turn or `length_m` to either side
  // of zero where these allow it.
  void Joints(const Arm& arm, double length_m, double* q) noexcept {
    for (int i = 0; i < arm.nominal.joints; ++i) {
      const double half = arm.nominal.prismatic[i] ? length_m : std::numbers::pi;
      double low = std::max(arm.limits[i].lower, -half), high = std::min(arm.limits[i].upper, half);
      if (!(low < high)) {
        low = std::isfinite(arm.limits[i].lower) ? arm.limits[i].lower : arm.limits[i].upper;
        high = std::isfinite(arm.limits[i].upper) ? arm.limits[i].upper : low;
      }
      q[i] = low + (high - low) * Next();
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace truepose::compensation
