#include "core/base/chi_square.h"

#include <unsupported/Eigen/SpecialFunctions>

namespace truepose {

double ChiSquareSurvival(double x, int k) {
  return x <= 0 ? 1 : Eigen::numext::igammac(0.5 * k, 0.5 * x);
}

double ChiSquareQuantile(double p, int k) {
  double low = 0, high = k + 10;
  while (ChiSquareSurvival(high, k) > 1 - p && high < 1e12) high *= 2;
  while (high - low > 1e-13 * high) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (ChiSquareSurvival(middle, k) > 1 - p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace truepose
