#include "core/base/f_distribution.h"

#include <unsupported/Eigen/SpecialFunctions>

namespace truepose {

double FSurvival(double x, double k1, double k2) {
  return x <= 0 ? 1 : Eigen::numext::betainc(0.5 * k2, 0.5 * k1, k2 / (k2 + k1 * x));
}

}  // namespace truepose
