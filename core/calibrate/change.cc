#include "core/calibrate/change.h"

#include <Eigen/Dense>
#include <algorithm>

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

}  // namespace

ChangeTest TestChange(const Problem& problem, const Eigen::VectorXd& stored_lambda,
                      const Eigen::MatrixXd& stored_covariance, Identification* identification) {
  const std::vector<int>& active = identification->set.active;
  const std::vector<int> held = HeldOf(problem, active);
  const Eigen::MatrixXd J =
      Whitened(problem, identification->estimate, identification->model_error).J;
  const Eigen::MatrixXd C = identification->covariance;
  const Eigen::MatrixXd G = -ScatterCovariance(*identification) *
                            (J(Eigen::all, active).transpose() * ColumnsOf(problem, J, held));
  identification->covariance += G * stored_covariance(held, held) * G.transpose();

  ChangeTest test;
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

}  // namespace truepose
