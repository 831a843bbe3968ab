// Numbers from a local, seeded generator that are the same on every platform; std distributions are
// not.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace truepose {

class Random {
 public:
  explicit Random(uint64_t seed) : generator_(seed) {}

  // Uniform in 0 .. bound - 1, by rejection of the last incomplete block of 2^64. @param bound > 0.
  uint64_t Below(uint64_t bound) {
    const uint64_t limit = UINT64_MAX - (UINT64_MAX % bound + 1) % bound;
    uint64_t value = generator_();
    while (value > limit) value = generator_();
    return value % bound;
  }

  // Uniform in [0, 1): the upper 53 bits.
  double Uniform() { return static_cast<double>(generator_() >> 11) * 0x1.0p-53; }
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }

  // Standard normal by Box and Muller; two uniforms a value.
  double Normal() {
    const double radius = std::sqrt(-2 * std::log(1 - Uniform()));
    return radius * std::cos(2 * std::numbers::pi * Uniform());
  }

 private:
  std::mt19937_64 generator_;
};

// 0 .. size - 1 shuffled by Fisher and Yates: for i = size - 1 down to 1 element i is swapped with
// one of 0 .. i.
inline std::vector<int> Shuffled(int size, uint64_t seed) {
  std::vector<int> order(static_cast<size_t>(size));
  std::iota(order.begin(), order.end(), 0);
  Random random(seed);
  for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.Below(i)]);
  return order;
}

}  // namespace truepose
