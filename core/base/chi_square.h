// The chi-square distribution of k degrees of freedom.
#pragma once

namespace truepose {

// P(X > x). @param k > 0. @returns 1 for x <= 0.
double ChiSquareSurvival(double x, int k);

// The x with P(X <= x) = p. @param p in [0, 1); to 1e-12 of x.
double ChiSquareQuantile(double p, int k);

}  // namespace truepose
