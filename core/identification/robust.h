// Losses that take weight from readings which don't fit, by reweighting.
//
// d^2 = r' R^-1 r of a reading with m rows, R without the loss' weight. Weights:
//   huber  w = min(1, c / d), c^2 the 82 % quantile of chi-square m (1.345^2 for m = 1)
//   tukey  w = (1 - d^2 / c^2)^2 below c = sqrt(m) + 3.685 (4.685 for m = 1), 0 beyond
// both at the usual 95 % efficiency for one row. Weights lower the mean of w r^2 of normal
// residuals too; Consistency() is by how much, so that s_model stays that of the good readings.
#pragma once

#include "core/identification/problem.h"
#include "core/identification/weights.h"

namespace truepose {

enum class Loss { kNone, kHuber, kTukey };

// "none", "huber", "tukey".
const char* Name(Loss loss);

// w(d) for a reading with `rows` rows.
double LossWeight(Loss loss, double d, int rows);

// E[(w d)^2] / (rows E[w]) for d^2 of chi-square with `rows` degrees of freedom.
double Consistency(Loss loss, int rows);

// What a robust loss costs in covariance: with psi(r) = w(d) r of the whitened residual r of a
// reading with m rows, n rows and p parameters in all,
//   factor = K^2 [ sum w^2 d^2 / (n - p) ] / mean(psi')^2,   psi' = w + w'(d) d / m,
//   K = 1 + p/n var(psi') / mean(psi')^2
// times (J' R^-1 J)^-1 of the readings without their weights is the covariance of the parameters
// (P. J. Huber, Robust Statistics, Wiley 1981, Sec. 7.6, Eq. 6.5; there for m = 1). It needs no
// assumption on how R is scaled.
// @param parameters p; less than the rows of the readings. @returns 1 without a loss, and where
// the loss leaves nothing (mean(psi') <= 0).
double RobustCovarianceFactor(Loss loss, const Problem& problem, const Estimate& estimate,
                              const ModelError& model_error, int parameters);

// d of a reading at an estimate: its residual in standard deviations, all rows together.
double ResidualSize(const Problem& problem, const Reading& reading, const Estimate& estimate,
                    const ModelError& model_error);

// Sets every reading's weight. @returns the largest change of a weight.
double Reweigh(Loss loss, const Estimate& estimate, const ModelError& model_error,
               Problem* problem);

}  // namespace truepose
