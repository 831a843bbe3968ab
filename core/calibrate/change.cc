#include "core/calibrate/change.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"

namespace truepose {
namespace {

// Below this probability a change counts as real.
constexpr double kReal = 0.01;

// Internal parameters (indices of the model) that are not active.
std::vector<int> HeldOf(const Problem& problem, const std::vector<int>& active) {
  std::vector<int> held;
  for (int i = 0; i < problem.model->parameters.size(); ++i) {
    if (!std::binary_search(active.begin(), active.end(), problem.FirstInternal() + i))
      held.push_back(i);
  }
  return held;
}

Eigen::MatrixXd ColumnsOf(const Problem& problem, const Eigen::MatrixXd& J,
                          const std::vector<int>& internal) {
  std::vector<int> columns = internal;
  for (int& column : columns) column += problem.FirstInternal();
  return J(Eigen::all, columns);
}

// Whitened with the weights of the readings that the identification ended with.
WhitenedSystem SystemOf(const Problem& problem, const Identification& identification) {
  Problem weighted = problem;
  for (size_t i = 0; i < identification.weights.size(); ++i)
    weighted.readings[i].weight = identification.weights[i];
  return Whitened(weighted, identification.estimate, identification.model_error);
}

// G: how errors of the held parameters move the estimate of the active ones.
Eigen::MatrixXd Influence(const Eigen::MatrixXd& J_active, const Eigen::MatrixXd& J_held) {
  const Eigen::VectorXd scale = J_active.colwise().norm().cwiseInverse();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(J_active * scale.asDiagonal());
  return -(scale.asDiagonal() * Eigen::MatrixXd(qr.solve(J_held)));
}

// L with C = L L', for a covariance that may be singular: m and rad are scaled to deviations first.
Eigen::MatrixXd RootOf(const Eigen::MatrixXd& C) {
  const Eigen::VectorXd sd = C.diagonal().cwiseMax(0).cwiseSqrt();
  const Eigen::VectorXd scale =
      sd.unaryExpr([](double value) { return value > 0 ? 1 / value : 0.0; });
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> unit(scale.asDiagonal() * C *
                                                            scale.asDiagonal());
  return sd.asDiagonal() * unit.eigenvectors() *
         unit.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

// What a result carries: `held` and `covariance`. @param of_held internal parameters.
void CarryForward(const Problem& problem, const std::vector<int>& of_held, const Eigen::MatrixXd& G,
                  const Eigen::MatrixXd& stored, const Eigen::MatrixXd& of_active,
                  ChangeTest* test) {
  std::vector<int> places, internal;  // among `of_held`, and as the model's parameters
  for (size_t i = 0; i < of_held.size(); ++i) {
    if (!(stored(of_held[i], of_held[i]) > 0)) continue;
    places.push_back(static_cast<int>(i));
    internal.push_back(of_held[i]);
    test->held.push_back(problem.FirstInternal() + of_held[i]);
  }
  const Eigen::Index a = of_active.rows(), h = static_cast<Eigen::Index>(internal.size());
  const Eigen::MatrixXd cross = G * stored(of_held, internal);
  test->covariance.resize(a + h, a + h);
  test->covariance << of_active, cross, cross.transpose(), stored(internal, internal);
}

}  // namespace

ChangeTest TestChange(const Problem& problem, const Eigen::VectorXd& stored_lambda,
                      const Eigen::MatrixXd& stored_covariance, Identification* identification) {
  const std::vector<int>& active = identification->set.active;
  const std::vector<int> held = HeldOf(problem, active);
  const Eigen::MatrixXd J = SystemOf(problem, *identification).J;
  const Eigen::MatrixXd C = identification->covariance;
  const Eigen::MatrixXd G = Influence(J(Eigen::all, active), ColumnsOf(problem, J, held));
  identification->covariance += G * stored_covariance(held, held) * G.transpose();

  ChangeTest test;
  CarryForward(problem, held, G, stored_covariance, identification->covariance, &test);
  std::vector<int> places, named;  // in `active`, and as the model's parameters
  for (size_t i = 0; i < active.size(); ++i) {
    if (active[i] < problem.FirstInternal()) continue;
    places.push_back(static_cast<int>(i));
    named.push_back(active[i] - problem.FirstInternal());
    test.names.push_back(problem.model->parameters[named.back()].name);
  }
  test.degrees_of_freedom = static_cast<int>(named.size());
  if (named.empty()) return test;
  std::vector<int> known = named;
  known.insert(known.end(), held.begin(), held.end());
  const auto n = static_cast<Eigen::Index>(named.size());
  Eigen::MatrixXd spread(n, n + static_cast<Eigen::Index>(held.size()));
  spread << -Eigen::MatrixXd::Identity(n, n), G(places, Eigen::all);
  const Eigen::MatrixXd S =
      C(places, places) + spread * stored_covariance(known, known) * spread.transpose();
  const Eigen::VectorXd difference = identification->estimate.lambda(named) - stored_lambda(named);
  test.chi_square = difference.dot(S.ldlt().solve(difference));
  test.p_value = ChiSquareSurvival(test.chi_square, test.degrees_of_freedom);
  test.real = test.p_value < kReal;
  return test;
}

HeldFit TestHeldFit(const Problem& problem, const Eigen::MatrixXd& stored_covariance,
                    const Identification& identification) {
  const std::vector<int>& active = identification.set.active;
  const std::vector<int> held = HeldOf(problem, active);
  WhitenedSystem system = SystemOf(problem, identification);
  const double factor = identification.variance_factor ? identification.variance_factor->value : 1;
  const Eigen::Index n = system.r.size(), a = static_cast<Eigen::Index>(active.size()),
                     h = static_cast<Eigen::Index>(held.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + h, a + h);
  A.topLeftCorner(n, a) = system.J(Eigen::all, active);
  A.topRightCorner(n, h) =
      ColumnsOf(problem, system.J, held) * RootOf(stored_covariance(held, held));
  A.topRows(n) /= std::sqrt(factor);
  A.bottomRightCorner(h, h).setIdentity();
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n + h);
  b.head(n) = system.r / std::sqrt(factor);
  const Eigen::VectorXd scale = A.colwise().norm().cwiseInverse();
  A = A * scale.asDiagonal();
  const Eigen::VectorXd left = b - A * Eigen::HouseholderQR<Eigen::MatrixXd>(A).solve(b);
  HeldFit fit{left.squaredNorm(), static_cast<int>(n - a), 1};
  if (fit.degrees_of_freedom > 0)
    fit.p_value = ChiSquareSurvival(fit.chi_square, fit.degrees_of_freedom);
  return fit;
}

}  // namespace truepose
