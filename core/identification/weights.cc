#include "core/identification/weights.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/identification/prediction.h"

namespace truepose {
namespace {

// A stated covariance may be singular (a coordinate that a fixture gives exactly); s_model is added
// before it is inverted, and this keeps a reading without any from dividing by zero.
constexpr double kLeastVariance = 1e-18;

bool NeedsFullCovariance(const Reading& reading) {
  return reading.covariance.has_value() || reading.joint_sd.size() > 0 ||
         reading.kind == ObservationKind::kDistance || reading.kind == ObservationKind::kPlane;
}

// S_stated + J_q S_q J_q' as the residual sees it, for readings whose rows are correlated.
ResidualMatrix FullStated(const Problem& problem, const Reading& reading,
                          const Estimate& estimate) {
  Residual r;
  ResidualByTwist D;
  KindOf(reading.kind).evaluate(reading, Predict(problem, reading, estimate), &r, &D);
  Eigen::Matrix<double, 6, 6> pose = Eigen::Matrix<double, 6, 6>::Zero();
  pose.diagonal() << reading.position_sd_m.array().square(),
      Eigen::Array3d::Constant(reading.rotation_sd_rad * reading.rotation_sd_rad);
  if (reading.covariance) pose += *reading.covariance;
  ResidualMatrix R = D * pose * D.transpose();
  if (reading.joint_sd.size() > 0) {
    Workspace workspace;
    const RowJacobian J = JointJacobian(problem, reading, estimate, &workspace);
    R += J * reading.joint_sd.array().square().matrix().asDiagonal() * J.transpose();
  }
  return R;
}

// The same where rows are not correlated; no kinematics needed.
ResidualMatrix DiagonalStated(const Reading& reading) {
  Residual variances(RowsOf(reading));
  int row = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const bool has = reading.kind != ObservationKind::kCoordinates || reading.coordinates[axis];
    if (has) variances(row++) = reading.position_sd_m(axis) * reading.position_sd_m(axis);
  }
  variances.tail(variances.size() - row)
      .setConstant(reading.rotation_sd_rad * reading.rotation_sd_rad);
  return variances.asDiagonal();
}

// R without s_model and weight.
ResidualMatrix StatedOf(const Problem& problem, const Reading& reading, const Estimate& estimate) {
  return NeedsFullCovariance(reading) ? FullStated(problem, reading, estimate)
                                      : DiagonalStated(reading);
}

// R without the weight.
ResidualMatrix Unweighted(const Problem& problem, const Reading& reading, const Estimate& estimate,
                          const ModelError& error) {
  ResidualMatrix R = StatedOf(problem, reading, estimate);
  const int positions = PositionRowsOf(reading);
  const auto variance = [](double sd) { return std::max(sd * sd, kLeastVariance); };
  R.diagonal().head(positions).array() += variance(error.position_sd_m);
  R.diagonal().tail(R.rows() - positions).array() += variance(error.rotation_sd_rad);
  return R;
}

WhitenedSystem Empty(const Problem& problem) {
  const int rows = RowsOf(problem) + PriorRowsOf(problem);
  WhitenedSystem system;
  system.r = system.raw = Eigen::VectorXd::Zero(rows);
  system.sd = system.weight = Eigen::VectorXd::Ones(rows);
  system.kind.assign(rows, WhitenedSystem::Row::kPrior);
  system.J = Eigen::MatrixXd::Zero(rows, problem.CandidateCount());
  return system;
}

void FillJacobian(const Problem& problem, const Reading& reading, int row, const ResidualMatrix& W,
                  const ReadingJacobian& J, Eigen::MatrixXd* out) {
  const Eigen::Index rows = W.rows();
  out->block(row, problem.FirstOfBase(reading.placement), rows, kFrameParameters) = W * J.base;
  out->block(row, problem.FirstOfTool(reading.target), rows, kFrameParameters) = W * J.tool;
  if (reading.offset >= 0)
    out->col(problem.FirstOfOffsets() + reading.offset).segment(row, rows) = W * J.offset;
  out->block(row, problem.FirstInternal(), rows, J.internal.cols()) = W * J.internal;
}

void FillRows(const Problem& problem, const Reading& reading, const Estimate& estimate,
              const ModelError& error, int row, WhitenedSystem* system) {
  const int rows = RowsOf(reading), positions = PositionRowsOf(reading);
  system->sd.segment(row, rows) =
      Unweighted(problem, reading, estimate, error).diagonal().cwiseSqrt();
  system->weight.segment(row, rows).setConstant(reading.weight);
  for (int i = 0; i < rows; ++i) {
    system->kind[row + i] =
        i < positions ? WhitenedSystem::Row::kPosition : WhitenedSystem::Row::kRotation;
  }
}

void FillPrior(const Problem& problem, const Estimate& estimate, int row, WhitenedSystem* system) {
  if (!problem.prior) return;
  const Prior& prior = *problem.prior;
  const Eigen::Index rows = prior.root.rows();
  system->r.segment(row, rows) = prior.root * (prior.mean - estimate.lambda);
  system->J.block(row, problem.FirstInternal(), rows, prior.root.cols()) = -prior.root;
}

}  // namespace

ResidualMatrix CovarianceOf(const Problem& problem, const Reading& reading,
                            const Estimate& estimate, const ModelError& model_error) {
  return Unweighted(problem, reading, estimate, model_error) / reading.weight;
}

int StatedRank(const Problem& problem, const Reading& reading, const Estimate& estimate) {
  constexpr double kNothing = 1e-10;  // of a variance
  const ResidualMatrix R = StatedOf(problem, reading, estimate);
  const Residual scale = R.diagonal().unaryExpr(
      [](double variance) { return variance > 0 ? 1 / std::sqrt(variance) : 0; });
  const Eigen::MatrixXd unit = scale.asDiagonal() * R * scale.asDiagonal();
  const Eigen::VectorXd directions =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(unit, Eigen::EigenvaluesOnly).eigenvalues();
  return static_cast<int>((directions.array() > kNothing).count());
}

ResidualMatrix WhitenerOf(const Problem& problem, const Reading& reading, const Estimate& estimate,
                          const ModelError& model_error) {
  const ResidualMatrix R = Unweighted(problem, reading, estimate, model_error);
  if (!NeedsFullCovariance(reading))
    return (std::sqrt(reading.weight) * R.diagonal().cwiseSqrt().cwiseInverse()).asDiagonal();
  const ResidualMatrix L = R.llt().matrixL();
  return L.triangularView<Eigen::Lower>().solve(
      ResidualMatrix(std::sqrt(reading.weight) * ResidualMatrix::Identity(R.rows(), R.cols())));
}

Whiteners WhitenersOf(const Problem& problem, const Estimate& estimate,
                      const ModelError& model_error) {
  Whiteners whiteners;
  whiteners.reserve(problem.readings.size());
  for (const Reading& reading : problem.readings)
    whiteners.push_back(WhitenerOf(problem, reading, estimate, model_error));
  return whiteners;
}

WhitenedSystem Whitened(const Problem& problem, const Estimate& estimate,
                        const ModelError& model_error) {
  return Whitened(problem, estimate, model_error, WhitenersOf(problem, estimate, model_error));
}

WhitenedSystem Whitened(const Problem& problem, const Estimate& estimate,
                        const ModelError& model_error, const Whiteners& whiteners) {
  WhitenedSystem system = Empty(problem);
  Workspace workspace;
  Residual r;
  ReadingJacobian J;
  int row = 0;
  for (size_t i = 0; i < problem.readings.size(); ++i) {
    const Reading& reading = problem.readings[i];
    EvaluateReading(*problem.model, reading, PointOf(reading, estimate), &workspace, &r, &J);
    system.raw.segment(row, r.size()) = r;
    system.r.segment(row, r.size()) = whiteners[i] * r;
    FillJacobian(problem, reading, row, whiteners[i], J, &system.J);
    FillRows(problem, reading, estimate, model_error, row, &system);
    row += static_cast<int>(r.size());
  }
  FillPrior(problem, estimate, row, &system);
  return system;
}

double CostOf(const Problem& problem, const Estimate& estimate, const Whiteners& whiteners) {
  double sum = 0;
  for (size_t i = 0; i < problem.readings.size(); ++i)
    sum += (whiteners[i] * ResidualAt(problem, problem.readings[i], estimate)).squaredNorm();
  if (problem.prior)
    sum += (problem.prior->root * (problem.prior->mean - estimate.lambda)).squaredNorm();
  return sum / 2;
}

}  // namespace truepose
