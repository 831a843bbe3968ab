// Sines and cosines of six angles at once: without branches and calls, so that the processor works
// on all of them together. Right to 1 unit of the last place of 1 (2.3e-16).
#pragma once

namespace truepose::compensation {

inline constexpr double kLargestAngle = 1e5;  // where the reduction below is exact

// @param angle  rad, absolute values at most kLargestAngle
inline void SinesOfSix(const double* angle, double* sine, double* cosine) noexcept {
  // pi / 2 in three parts, of which the first two leave room for a factor of 2^20.
  constexpr double kFirst = 0x1.921fb544p+0, kSecond = 0x1.0b4611a6p-34;
  constexpr double kThird = 0x1.3198a2e037073p-69, kInverse = 0x1.45f306dc9c883p-1;
  // Added and taken away again, it rounds to an integer.
  constexpr double kRound = 0x1.8p52;
  for (int i = 0; i < 6; ++i) {
    const double quarters = (angle[i] * kInverse + kRound) - kRound;
    const double x = ((angle[i] - quarters * kFirst) - quarters * kSecond) - quarters * kThird;
    const double b = x * x;
    // Taylor: at pi / 4 the next terms are below 1e-17.
    const double s =
        x - x * b *
                (1 / 6.0 -
                 b * (1 / 120.0 -
                      b * (1 / 5040.0 -
                           b * (1 / 362880.0 - b * (1 / 39916800.0 - b * (1 / 6227020800.0 -
                                                                          b / 1307674368000.0))))));
    const double c =
        1 - b * (0.5 - b * (1 / 24.0 -
                            b * (1 / 720.0 -
                                 b * (1 / 40320.0 -
                                      b * (1 / 3628800.0 -
                                           b * (1 / 479001600.0 - b * (1 / 87178291200.0 -
                                                                       b / 20922789888000.0)))))));
    const int quadrant = static_cast<int>(quarters);
    const bool swapped = quadrant & 1;
    const double first = swapped ? c : s, second = swapped ? s : c;
    sine[i] = quadrant & 2 ? -first : first;
    cosine[i] = (quadrant + 1) & 2 ? -second : second;
  }
}

}  // namespace truepose::compensation
