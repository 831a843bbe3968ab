#include "core/drift/drift_fit.h"

#include <Eigen/Dense>
#include <numeric>

#include "core/identification/candidate_values.h"
#include "core/identification/weighted_problem.h"

namespace truepose {
namespace {

constexpr int kMostIterations = 12, kMostHalvings = 6;
// A decrease below this share of the sum, and of 1, changes no probability.
constexpr double kSmallDecrease = 1e-8;
// Directions weaker than this against the others, columns scaled to norm 1, are dependent.
constexpr double kDependent = 1e-7;

// A with A A' = C, directions without variance left out.
Eigen::MatrixXd RootOf(const Eigen::MatrixXd& C) {
  const Eigen::VectorXd sd = C.diagonal().cwiseMax(0).cwiseSqrt();
  const Eigen::VectorXd inverse = sd.unaryExpr([](double s) { return s > 0 ? 1 / s : 0.0; });
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(inverse.asDiagonal() * C *
                                                             inverse.asDiagonal());
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < sd.size(); ++i)
    if (eigen.eigenvalues()(i) > 1e-12) kept.push_back(i);
  return sd.asDiagonal() * eigen.eigenvectors()(Eigen::all, kept) *
         eigen.eigenvalues()(kept).cwiseSqrt().asDiagonal();
}

Eigen::ColPivHouseholderQR<Eigen::MatrixXd> ScaledQr(const Eigen::MatrixXd& J,
                                                     const Eigen::VectorXd& scale) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(J.rows(), J.cols());
  qr.setThreshold(kDependent);
  qr.compute(J * scale.asDiagonal());
  return qr;
}

}  // namespace

Freedom operator+(const Freedom& a, const Freedom& b) {
  Freedom sum = a;
  sum.candidates.insert(sum.candidates.end(), b.candidates.begin(), b.candidates.end());
  sum.joints.insert(sum.joints.end(), b.joints.begin(), b.joints.end());
  return sum;
}

DriftFitter::DriftFitter(const DriftProblem& problem, const Estimate& start)
    : problem_(problem),
      start_(start),
      start_values_(ValuesOf(problem.check, start)),
      whitener_(problem.check, start, problem.model_error),
      root_(RootOf(problem.covariance)) {
  for (const Reading& reading : problem.check.readings) rows_ += RowsOf(reading);
}

Eigen::VectorXd DriftFitter::Values(const Freedom& freedom, const Point& point) const {
  Eigen::VectorXd values = start_values_;
  if (point.z.size() > 0) values += root_ * point.z;
  values(freedom.candidates) += point.y.head(static_cast<Eigen::Index>(freedom.candidates.size()));
  return values;
}

Eigen::VectorXd DriftFitter::Joints(const Freedom& freedom, const Point& point) const {
  Eigen::VectorXd joints = Eigen::VectorXd::Zero(problem_.robot->joint_count());
  joints(freedom.joints) = point.y.tail(static_cast<Eigen::Index>(freedom.joints.size()));
  return joints;
}

Reading DriftFitter::Moved(const Reading& reading, const Eigen::VectorXd& joints) const {
  Reading moved = reading;
  moved.q += problem_.robot->joint_map().scale * joints;
  return moved;
}

Eigen::VectorXd DriftFitter::Residuals(const Freedom& freedom, const Point& point) const {
  const Eigen::VectorXd values = Values(freedom, point), joints = Joints(freedom, point);
  Eigen::VectorXd r(rows_);
  Eigen::Index row = 0;
  Residual part;
  for (const Reading& reading : problem_.check.readings) {
    const Reading moved = Moved(reading, joints);
    EvaluateReading(*problem_.check.model, moved, PointAt(problem_.check, moved, start_, values),
                    nullptr, &part, nullptr);
    r.segment(row, part.size()) = part;
    row += part.size();
  }
  return whitener_.Apply(r);
}

double DriftFitter::Cost(const Freedom& freedom, const Point& point) const {
  return Residuals(freedom, point).squaredNorm() + point.z.squaredNorm();
}

DriftFitter::System DriftFitter::Linearise(const Freedom& freedom, const Point& point) const {
  const Problem& check = problem_.check;
  const Eigen::VectorXd values = Values(freedom, point), joints = Joints(freedom, point);
  const Estimate estimate = EstimateAt(check, start_, values);
  std::vector<int> all(static_cast<size_t>(check.CandidateCount()));
  std::iota(all.begin(), all.end(), 0);
  Eigen::MatrixXd by_candidates(rows_, check.CandidateCount()), by_joints(rows_, joints.size());
  Eigen::VectorXd r(rows_);
  Eigen::Index row = 0;
  Workspace workspace;
  Residual part;
  RowJacobian by;
  for (const Reading& reading : check.readings) {
    const Reading moved = Moved(reading, joints);
    const int n = RowsOf(reading);
    LineariseReading(check, moved, ResidualMatrix::Identity(n, n), all, start_, values, &workspace,
                     &part, &by);
    r.segment(row, n) = part;
    by_candidates.middleRows(row, n) = by;
    by_joints.middleRows(row, n) = JointJacobian(check, moved, estimate, &workspace);
    row += n;
  }
  const Eigen::Index z = point.z.size();
  Eigen::MatrixXd J(rows_, z + point.y.size());
  if (z > 0) J.leftCols(z) = by_candidates * root_;
  J.rightCols(point.y.size()) << by_candidates(Eigen::all, freedom.candidates),
      (by_joints * problem_.robot->joint_map().scale)(Eigen::all, freedom.joints);
  System system{Eigen::VectorXd(rows_ + z), Eigen::MatrixXd::Zero(rows_ + z, J.cols())};
  system.r << whitener_.Apply(r), point.z;
  system.J.topRows(rows_) = whitener_.Apply(J);
  system.J.bottomLeftCorner(z, z).setIdentity();
  return system;
}

DriftFit DriftFitter::Fit(const Freedom& freedom, bool with_covariance) const {
  const auto free = static_cast<Eigen::Index>(freedom.candidates.size() + freedom.joints.size());
  const Eigen::Index z = with_covariance ? root_.cols() : 0;
  Point point{Eigen::VectorXd::Zero(z), Eigen::VectorXd::Zero(free)};
  DriftFit fit;
  fit.chi_square = Cost(freedom, point);
  for (int iteration = 0; iteration < kMostIterations && z + free > 0; ++iteration) {
    const System system = Linearise(freedom, point);
    const Eigen::VectorXd scale = ColumnScale(system.J);
    const auto qr = ScaledQr(system.J, scale);
    fit.rank = static_cast<int>(qr.rank() - z);
    Eigen::VectorXd step = scale.asDiagonal() * Eigen::VectorXd(qr.solve(-system.r));
    double cost = fit.chi_square;
    Point next = point;
    for (int halving = 0; halving <= kMostHalvings && cost >= fit.chi_square; ++halving) {
      next = {point.z + step.head(z), point.y + step.tail(free)};
      cost = Cost(freedom, next);
      step /= 2;
    }
    if (cost >= fit.chi_square) break;
    const bool small = fit.chi_square - cost < kSmallDecrease * (1 + cost);
    fit.chi_square = cost;
    point = next;
    if (small) break;
  }
  fit.values = Values(freedom, point);
  fit.changes = point.y;
  fit.joints = Joints(freedom, point);
  fit.whitened = Residuals(freedom, point);
  return fit;
}

}  // namespace truepose
