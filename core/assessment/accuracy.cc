#include "core/assessment/accuracy.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/identification/prediction.h"

namespace truepose {
namespace {

constexpr double kRegion = 0.95;

// Position rows of one reading: residual, J C J' and R.
struct PositionPrediction {
  Eigen::VectorXd r;
  Eigen::MatrixXd of_parameters, of_reading;
};

std::vector<PositionPrediction> Predictions(const Problem& problem,
                                            const Identification& identification,
                                            const Eigen::MatrixXd& C) {
  Problem readings_alone = problem;
  readings_alone.prior.reset();
  Whiteners identity;
  for (const Reading& reading : problem.readings)
    identity.push_back(ResidualMatrix::Identity(RowsOf(reading), RowsOf(reading)));
  const WhitenedSystem system =
      Whitened(readings_alone, identification.estimate, identification.model_error, identity);
  const double factor = identification.variance_factor ? identification.variance_factor->value : 1;
  std::vector<PositionPrediction> predictions;
  Eigen::Index row = 0;
  for (const Reading& reading : problem.readings) {
    const Eigen::Index rows = PositionRowsOf(reading);
    const Eigen::MatrixXd J = system.J.middleRows(row, rows)(Eigen::all, identification.set.active);
    Reading unweighted = reading;
    unweighted.weight = 1;
    const ResidualMatrix R = factor * CovarianceOf(problem, unweighted, identification.estimate,
                                                   identification.model_error);
    predictions.push_back(
        {system.raw.segment(row, rows), J * C * J.transpose(), R.topLeftCorner(rows, rows)});
    row += RowsOf(reading);
  }
  return predictions;
}

constexpr double kNormalReadings = 100;

double SizeIn(const Eigen::VectorXd& r, const Eigen::MatrixXd& S) {
  return r.dot(S.ldlt().solve(r));
}

// R - J C J'. C is wider than (J'J)^-1 where parameters are held with an uncertainty of their own
// (change.h), and the difference may then not be positive: R alone bounds it.
Eigen::MatrixXd CovarianceOfResidual(const PositionPrediction& p) {
  const Eigen::MatrixXd S = p.of_reading - p.of_parameters;
  return S.llt().info() == Eigen::Success ? S : p.of_reading;
}

// k of the region, as a multiple of the quantile of chi-square, so that readings with one row and
// with three count alike.
double RegionFactor(const Problem& calibration, const Identification& identification) {
  std::vector<double> ratios;
  for (const PositionPrediction& p :
       Predictions(calibration, identification, ScatterCovariance(identification))) {
    const double size = SizeIn(p.r, CovarianceOfResidual(p));
    ratios.push_back(size / ChiSquareQuantile(kRegion, static_cast<int>(p.r.size())));
  }
  const double n = static_cast<double>(ratios.size());
  if (ratios.empty()) return 1;
  const size_t rank =
      std::min(ratios.size() - 1, static_cast<size_t>(std::ceil(kRegion * (n + 1))) - 1);
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(rank),
                   ratios.end());
  return (n * ratios[rank] + kNormalReadings) / (n + kNormalReadings);
}

bool Inside(const Eigen::VectorXd& r, const Eigen::MatrixXd& S, double factor) {
  return SizeIn(r, S) <= factor * ChiSquareQuantile(kRegion, static_cast<int>(r.size()));
}

// Position of every reading by all candidates, three rows each, not weighted.
Eigen::MatrixXd PositionJacobian(const Problem& problem, const Identification& identification) {
  Problem points = problem;
  points.prior.reset();
  for (Reading& reading : points.readings) reading.kind = ObservationKind::kPoint;
  const Whiteners identity(points.readings.size(), ResidualMatrix::Identity(3, 3));
  return Whitened(points, identification.estimate, identification.model_error, identity).J;
}

}  // namespace

PredictedAccuracy Predicted(const Problem& control, const Problem& calibration,
                            const Identification& identification) {
  PredictedAccuracy result;
  if (identification.covariance.size() == 0 || control.readings.empty()) return result;
  const double factor = RegionFactor(calibration, identification);
  double traces = 0;
  for (const PositionPrediction& p :
       Predictions(control, identification, identification.covariance)) {
    const Eigen::MatrixXd S = p.of_parameters + p.of_reading;
    ++result.control;
    result.inside += Inside(p.r, S, factor);
    result.inside_covariance_alone += Inside(p.r, p.of_parameters, 1);
    traces += S.trace();
  }
  result.position_rms_m = std::sqrt(traces / result.control);
  return result;
}

double ParameterUncertainty(const Problem& problem, const Identification& identification) {
  if (identification.covariance.size() == 0 || problem.readings.empty()) return 0;
  const Eigen::MatrixXd J = PositionJacobian(problem, identification);
  std::vector<int> internal, places;
  for (size_t i = 0; i < identification.set.active.size(); ++i) {
    if (identification.set.active[i] < problem.FirstInternal()) continue;
    internal.push_back(identification.set.active[i]);
    places.push_back(static_cast<int>(i));
  }
  const Eigen::MatrixXd frames = J.leftCols(problem.FirstInternal());
  const Eigen::MatrixXd moved = J(Eigen::all, internal);
  const Eigen::MatrixXd left =
      moved - frames * frames.completeOrthogonalDecomposition().solve(moved);
  const Eigen::MatrixXd C = identification.covariance(places, places);
  return std::sqrt((left * C).cwiseProduct(left).sum() /
                   static_cast<double>(problem.readings.size()));
}

std::vector<Correlation> Correlations(const Identification& identification, double above) {
  std::vector<Correlation> result;
  const Eigen::MatrixXd& C = identification.covariance;
  for (Eigen::Index i = 0; i < C.rows(); ++i) {
    for (Eigen::Index j = i + 1; j < C.cols(); ++j) {
      const double value = C(i, j) / std::sqrt(C(i, i) * C(j, j));
      if (std::abs(value) > above)
        result.push_back({identification.set.active[i], identification.set.active[j], value});
    }
  }
  return result;
}

}  // namespace truepose
