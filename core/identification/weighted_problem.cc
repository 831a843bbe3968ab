#include "core/identification/weighted_problem.h"

#include <Eigen/Dense>
#include <algorithm>

namespace truepose {
namespace {

// Writes the derivative by one candidate; a candidate of another frame has none.
void CopyColumn(const Problem& problem, const Reading& reading, const ReadingJacobian& J,
                int candidate, Eigen::Ref<Eigen::VectorXd> out) {
  const int base = candidate - problem.FirstOfBase(reading.placement),
            tool = candidate - problem.FirstOfTool(reading.target),
            internal = candidate - problem.FirstInternal();
  if (base >= 0 && base < kFrameParameters) {
    out = J.base.col(base);
  } else if (tool >= 0 && tool < kFrameParameters) {
    out = J.tool.col(tool);
  } else if (internal >= 0) {
    out = J.internal.col(internal);
  } else if (reading.offset >= 0 && candidate == problem.FirstOfOffsets() + reading.offset) {
    out = J.offset;
  } else {
    out.setZero();
  }
}

}  // namespace

void LineariseReading(const Problem& problem, const Reading& reading, const ResidualMatrix& W,
                      const std::vector<int>& active, const Estimate& start,
                      const Eigen::VectorXd& values, Workspace* workspace, Residual* r,
                      RowJacobian* J) {
  ReadingJacobian by;
  EvaluateReading(*problem.model, reading, PointAt(problem, reading, start, values), workspace, r,
                  &by);
  Eigen::MatrixXd columns(r->size(), static_cast<Eigen::Index>(active.size()));
  for (size_t k = 0; k < active.size(); ++k)
    CopyColumn(problem, reading, by, active[k], columns.col(static_cast<Eigen::Index>(k)));
  *r = (W * *r).eval();
  *J = W * columns;
}

void LinearisePrior(const Problem& problem, const std::vector<int>& active,
                    const Eigen::VectorXd& values, Eigen::VectorXd* r, Eigen::MatrixXd* J) {
  const Eigen::Index rows = problem.prior ? problem.prior->root.rows() : 0;
  *r = Eigen::VectorXd::Zero(rows);
  *J = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(active.size()));
  if (rows == 0) return;
  const Prior& prior = *problem.prior;
  *r = prior.root * (prior.mean - values.tail(prior.mean.size()));
  for (size_t k = 0; k < active.size(); ++k) {
    if (active[k] < problem.FirstInternal()) continue;
    J->col(static_cast<Eigen::Index>(k)) = -prior.root.col(active[k] - problem.FirstInternal());
  }
}

WeightedProblem::WeightedProblem(const Problem& problem, const ModelError& model_error,
                                 const std::vector<int>& active, const Estimate& start)
    : problem_(problem),
      active_(active),
      start_(start),
      start_values_(ValuesOf(problem, start)),
      whiteners_(WhitenersOf(problem, start, model_error)) {}

Eigen::VectorXd WeightedProblem::Start() const { return start_values_(active_); }

Eigen::VectorXd WeightedProblem::Values(const Eigen::VectorXd& x) const {
  Eigen::VectorXd values = start_values_;
  values(active_) = x;
  return values;
}

Estimate WeightedProblem::At(const Eigen::VectorXd& x) const {
  return EstimateAt(problem_, start_, Values(x));
}

double WeightedProblem::Cost(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd values = Values(x);
  Eigen::VectorXd prior;
  Eigen::MatrixXd unused;
  LinearisePrior(problem_, active_, values, &prior, &unused);
  double sum = prior.squaredNorm();
  Residual r;
  for (size_t i = 0; i < whiteners_.size(); ++i) {
    const Reading& reading = problem_.readings[i];
    EvaluateReading(*problem_.model, reading, PointAt(problem_, reading, start_, values), nullptr,
                    &r, nullptr);
    sum += (whiteners_[i] * r).squaredNorm();
  }
  return sum / 2;
}

double WeightedProblem::MeanPositionError(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd values = Values(x);
  double sum = 0;
  int count = 0;
  Residual r;
  for (const Reading& reading : problem_.readings) {
    const int rows = PositionRowsOf(reading);
    if (rows == 0) continue;
    EvaluateReading(*problem_.model, reading, PointAt(problem_, reading, start_, values), nullptr,
                    &r, nullptr);
    sum += r.head(rows).norm();
    ++count;
  }
  return sum / std::max(count, 1);
}

void WeightedProblem::Linearise(const Eigen::VectorXd& x, Eigen::VectorXd* r,
                                Eigen::MatrixXd* J) const {
  const Eigen::VectorXd values = Values(x);
  r->resize(RowsOf(problem_) + PriorRowsOf(problem_));
  J->resize(r->size(), size());
  Workspace workspace;
  Residual part;
  RowJacobian by;
  Eigen::Index row = 0;
  for (size_t i = 0; i < whiteners_.size(); ++i, row += part.size()) {
    LineariseReading(problem_, problem_.readings[i], whiteners_[i], active_, start_, values,
                     &workspace, &part, &by);
    r->segment(row, part.size()) = part;
    J->middleRows(row, part.size()) = by;
  }
  Eigen::VectorXd prior;
  Eigen::MatrixXd by_prior;
  LinearisePrior(problem_, active_, values, &prior, &by_prior);
  r->tail(prior.size()) = prior;
  J->bottomRows(prior.size()) = by_prior;
}

Eigen::MatrixXd WeightedProblem::PositionJacobian(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd values = Values(x);
  Eigen::MatrixXd J(RowsOf(problem_), size());
  Workspace workspace;
  Residual r;
  RowJacobian by;
  Eigen::Index row = 0;
  for (const Reading& reading : problem_.readings) {
    const int rows = PositionRowsOf(reading), all = RowsOf(reading);
    LineariseReading(problem_, reading, ResidualMatrix::Identity(all, all), active_, start_, values,
                     &workspace, &r, &by);
    J.middleRows(row, rows) = by.topRows(rows);
    row += rows;
  }
  return J.topRows(row);
}

Eigen::VectorXd ColumnScale(const Eigen::MatrixXd& J) {
  const Eigen::VectorXd norm = J.colwise().norm();
  const double zero = 1e-13 * norm.maxCoeff();
  return norm.unaryExpr([&](double value) { return value > zero ? 1 / value : 0.0; });
}

LinearStep SolveLinear(const Eigen::VectorXd& r, const Eigen::MatrixXd& J) {
  LinearStep step;
  const Eigen::VectorXd scale = ColumnScale(J);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(J * scale.asDiagonal());
  step.determined = qr.rank() == J.cols();
  step.x = scale.asDiagonal() * Eigen::VectorXd(qr.solve(-r));
  const Eigen::VectorXd rotated = qr.householderQ().adjoint() * r;
  step.decrease = rotated.head(qr.rank()).squaredNorm() / 2;
  return step;
}

}  // namespace truepose
