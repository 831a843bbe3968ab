#include "compensation/singularity.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace truepose::compensation {
namespace {

constexpr double kLarge = 1e6;

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
  using Square = Eigen::Matrix<double, 6, 6>;
  // Of fewer joints J^T J, with eigenvalues that are never the least where it has no joint.
  Square square = Square::Identity() * kLarge;
  if (chain.joints >= 6)
    square = J.lazyProduct(J.transpose());
  else
    square.topLeftCorner(chain.joints, chain.joints) = J.transpose().lazyProduct(J);
  const Eigen::SelfAdjointEigenSolver<Square> solver(square, Eigen::EigenvaluesOnly);
  const double least = solver.eigenvalues()(0);
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
