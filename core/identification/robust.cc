#include "core/identification/robust.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/identification/prediction.h"

namespace truepose {
namespace {

// The part of a normal sample that Huber's loss leaves alone at 95 % efficiency: P(|z| < 1.345).
constexpr double kHuberShare = 0.8214;
constexpr double kTukeyReach = 3.685;

double Threshold(Loss loss, int rows) {
  return loss == Loss::kHuber ? std::sqrt(ChiSquareQuantile(kHuberShare, rows))
                              : std::sqrt(static_cast<double>(rows)) + kTukeyReach;
}

double WeightAt(Loss loss, double d, double c) {
  if (loss == Loss::kNone) return 1;
  if (loss == Loss::kHuber) return d <= c ? 1 : c / d;
  const double u = 1 - (d / c) * (d / c);
  return u > 0 ? u * u : 0;
}

// d psi / d r averaged over the directions of r: w + w' d / rows.
double Slope(Loss loss, double d, int rows) {
  const double c = Threshold(loss, rows);
  if (loss == Loss::kHuber) return d <= c ? 1 : c / d * (1 - 1.0 / rows);
  const double u = 1 - (d / c) * (d / c);
  return u > 0 ? u * u - 4 * u * (d / c) * (d / c) / rows : 0;
}

}  // namespace

const char* Name(Loss loss) {
  if (loss == Loss::kHuber) return "huber";
  return loss == Loss::kTukey ? "tukey" : "none";
}

double LossWeight(Loss loss, double d, int rows) {
  return loss == Loss::kNone ? 1 : WeightAt(loss, d, Threshold(loss, rows));
}

// The density of d is d^(rows-1) exp(-d^2/2) up to a factor that cancels; beyond 12 it is nothing.
double Consistency(Loss loss, int rows) {
  if (loss == Loss::kNone) return 1;
  const double c = Threshold(loss, rows), step = 1e-3;
  double weighted = 0, weights = 0;
  for (double d = step / 2; d < 12; d += step) {
    const double density = std::pow(d, rows - 1) * std::exp(-d * d / 2);
    const double weight = WeightAt(loss, d, c);
    weighted += density * weight * weight * d * d;
    weights += density * weight;
  }
  return weighted / (rows * weights);
}

double ResidualSize(const Problem& problem, const Reading& reading, const Estimate& estimate,
                    const ModelError& model_error) {
  Reading unweighted = reading;
  unweighted.weight = 1;
  return (WhitenerOf(problem, unweighted, estimate, model_error) *
          ResidualAt(problem, reading, estimate))
      .norm();
}

double RobustCovarianceFactor(Loss loss, const Problem& problem, const Estimate& estimate,
                              const ModelError& model_error, int parameters) {
  if (loss == Loss::kNone) return 1;
  double squares = 0, slopes = 0, squared_slopes = 0, n = 0;
  for (const Reading& reading : problem.readings) {
    const int rows = RowsOf(reading);
    const double d = ResidualSize(problem, reading, estimate, model_error);
    const double weighted = LossWeight(loss, d, rows) * d, slope = Slope(loss, d, rows);
    squares += weighted * weighted;
    slopes += rows * slope;
    squared_slopes += rows * slope * slope;
    n += rows;
  }
  const double mean = slopes / n, variance = squared_slopes / n - mean * mean;
  if (!(mean > 0)) return 1;
  const double K = 1 + parameters / n * variance / (mean * mean);
  return K * K * squares / (n - parameters) / (mean * mean);
}

double Reweigh(Loss loss, const Estimate& estimate, const ModelError& model_error,
               Problem* problem) {
  double change = 0;
  for (Reading& reading : problem->readings) {
    const double weight =
        LossWeight(loss, ResidualSize(*problem, reading, estimate, model_error), RowsOf(reading));
    change = std::max(change, std::abs(weight - reading.weight));
    reading.weight = weight;
  }
  return change;
}

}  // namespace truepose
