#include "core/conversion/singular_link.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/fault.h"
#include "core/conversion/describe.h"
#include "core/identification/weights.h"

namespace truepose {
namespace {

// Parts below this share of a column are rounding.
constexpr double kExplained = 1e-6;

// The effect of a parameter of `from`, as far as `to` can't follow it.
struct Missing {
  int parameter = -1;
  double size = 0;
};

Eigen::MatrixXd InternalColumns(const Problem& problem, const Estimate& estimate) {
  const Eigen::MatrixXd J = Whitened(problem, estimate, ModelError{}).J;
  return J.rightCols(J.cols() - problem.FirstInternal());
}

// Of each parameter of `from` at its value, the part that no parameter of `to` explains.
Missing LargestMissing(const ConversionProblem& c) {
  Problem of_from = c.problem;
  of_from.model = &c.from;
  const Eigen::MatrixXd columns = InternalColumns(of_from, NominalEstimate(of_from));
  Eigen::MatrixXd span = Whitened(c.problem, c.start, ModelError{}).J(Eigen::all, c.active);
  span.colwise().normalize();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(span);
  const Eigen::Index rank = span.cols();
  Missing missing;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    if (c.from.parameters[static_cast<int>(k)].role == ParameterRole::kEffect) continue;
    const Eigen::VectorXd rotated = qr.householderQ().transpose() * columns.col(k);
    const double left = rotated.tail(rotated.size() - rank).norm();
    const double size = left * std::abs(c.lambda(k));
    if (left > kExplained * rotated.norm() && size > missing.size)
      missing = {static_cast<int>(k), size};
  }
  return missing;
}

std::string ValueText(const Parameter& parameter, double value) {
  return parameter.is_angle() ? absl::StrFormat("%s = %.6g mrad", parameter.name, 1e3 * value)
                              : absl::StrFormat("%s = %.6g mm", parameter.name, 1e3 * value);
}

absl::Status FaultAt(const ConversionProblem& c, const std::string& parameter,
                     const std::string& found) {
  const int joint = std::max(LinkOf(parameter).value_or(1), 1) - 1;
  FaultList faults;
  faults.Add(absl::StrCat("joints[", joint, "]"), found,
             absl::StrCat("a form of ", c.problem.model->kind, " that is regular at joint ",
                          c.robot.joints()[joint].name,
                          ": D&H is singular between parallel axes, Hayati at coincident ones"));
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

// A singular link drives the parameters of the next one to the same size the other way: of those
// within a factor of two of the largest the first is its own.
int FirstOfLargest(const Model& to, const Eigen::VectorXd& lambda) {
  const double largest = LargestValue(to, lambda);
  int first = 0;
  while (to.parameters[first].role == ParameterRole::kEffect ||
         std::abs(lambda(first)) < largest / 2)
    ++first;
  return first;
}

}  // namespace

double LargestValue(const Model& model, const Eigen::VectorXd& lambda) {
  double largest = 0;
  for (int i = 0; i < model.parameters.size(); ++i) {
    if (model.parameters[i].role != ParameterRole::kEffect)
      largest = std::max(largest, std::abs(lambda(i)));
  }
  return largest;
}

absl::Status SingularLink(const ConversionProblem& c) {
  const std::string gap = absl::StrFormat("; %.3g mm and %.3g mrad are left",
                                          1e3 * c.worst.position_m, 1e3 * c.worst.rotation_rad);
  const Missing missing = LargestMissing(c);
  const Model& to = *c.problem.model;
  if (missing.parameter >= 0) {
    const Parameter& parameter = c.from.parameters[missing.parameter];
    return FaultAt(
        c, parameter.name,
        absl::StrCat(ValueText(parameter, c.lambda(missing.parameter)), " of ", c.from.kind,
                     ", which no parameter of ", to.kind, " expresses", gap));
  }
  const int first = FirstOfLargest(to, c.solved.lambda);
  const Parameter& parameter = to.parameters[first];
  return FaultAt(c, parameter.name,
                 absl::StrCat(ValueText(parameter, c.solved.lambda(first)), " of ", to.kind,
                              ", which ran away", gap));
}

}  // namespace truepose
