#include "compensation/singularity.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace truepose::compensation {
namespace {

Jacobian WithoutUnits(const JointChain& chain, const Sweep& sweep, double length_m) {
  Jacobian J = JacobianOf(chain, sweep);
  J.topRows<3>() /= length_m;
  for (int i = 0; i < chain.joints; ++i) {
    if (chain.prismatic[i]) J.col(i) *= length_m;
  }
  return J;
}

}  // namespace

double CharacteristicLength(const JointChain& chain) noexcept {
  double sum = 0;
  for (int i = 1; i < chain.joints; ++i) sum += chain.constant[i].p.norm();
  return sum > 0 ? 0.5 * sum : 1;
}

double SmallestSingularValue(const JointChain& chain, const Sweep& sweep,
                             double length_m) noexcept {
  // Roots of eigenvalues are right to 1e-8; what is asked is whether the value is below 1e-3.
  const Jacobian J = WithoutUnits(chain, sweep, length_m);
  double least;
  if (chain.joints >= 6) {
    const Eigen::Matrix<double, 6, 6> square = J.lazyProduct(J.transpose());
    least =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(square, Eigen::EigenvaluesOnly)
            .eigenvalues()(0);
  } else {
    using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 5, 5>;
    const Small square = J.transpose().lazyProduct(J);
    least = Eigen::SelfAdjointEigenSolver<Small>(square, Eigen::EigenvaluesOnly).eigenvalues()(0);
  }
  return std::sqrt(std::max(0.0, least));
}

double SmallestSingularValue(const Arm& arm, const double* q, double length_m) noexcept {
  JointArray q_chain;
  ToChain(arm, q, q_chain.data());
  Motions motions;
  SetMotions(arm.nominal, q_chain.data(), &motions);
  Sweep sweep;
  RunSweep(arm.nominal, motions, &sweep);
  return SmallestSingularValue(arm.nominal, sweep, length_m);
}

}  // namespace truepose::compensation
