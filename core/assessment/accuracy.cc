#include "core/assessment/accuracy.h"

#include <Eigen/Dense>
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
                                            const Identification& identification) {
  Problem readings_alone = problem;
  readings_alone.prior.reset();
  Whiteners identity;
  for (const Reading& reading : problem.readings)
    identity.push_back(ResidualMatrix::Identity(RowsOf(reading), RowsOf(reading)));
  const WhitenedSystem system =
      Whitened(readings_alone, identification.estimate, identification.model_error, identity);
  std::vector<PositionPrediction> predictions;
  Eigen::Index row = 0;
  for (const Reading& reading : problem.readings) {
    const Eigen::Index rows = PositionRowsOf(reading);
    const Eigen::MatrixXd J = system.J.middleRows(row, rows)(Eigen::all, identification.set.active);
    Reading unweighted = reading;
    unweighted.weight = 1;
    const ResidualMatrix R =
        CovarianceOf(problem, unweighted, identification.estimate, identification.model_error);
    predictions.push_back({system.raw.segment(row, rows),
                           J * identification.covariance * J.transpose(),
                           R.topLeftCorner(rows, rows)});
    row += RowsOf(reading);
  }
  return predictions;
}

bool Inside(const Eigen::VectorXd& r, const Eigen::MatrixXd& S) {
  return r.dot(S.ldlt().solve(r)) <= ChiSquareQuantile(kRegion, static_cast<int>(r.size()));
}

}  // namespace

PredictedAccuracy Predicted(const Problem& problem, const Identification& identification) {
  PredictedAccuracy result;
  if (identification.covariance.size() == 0) return result;
  double traces = 0;
  for (const PositionPrediction& p : Predictions(problem, identification)) {
    const Eigen::MatrixXd S = p.of_parameters + p.of_reading;
    ++result.control;
    result.inside += Inside(p.r, S);
    result.inside_covariance_alone += Inside(p.r, p.of_parameters);
    traces += S.trace();
  }
  if (result.control > 0) result.position_rms_m = std::sqrt(traces / result.control);
  return result;
}

double ParameterUncertainty(const Problem& problem, const Identification& identification) {
  if (identification.covariance.size() == 0 || problem.readings.empty()) return 0;
  double traces = 0;
  for (const PositionPrediction& p : Predictions(problem, identification))
    traces += p.of_parameters.trace();
  return std::sqrt(traces / static_cast<double>(problem.readings.size()));
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
