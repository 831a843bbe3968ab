// Readings that do not fit the others.
#pragma once

#include <string>
#include <vector>

#include "core/identification/identify.h"

namespace truepose {

struct Suspect {
  int reading = 0;     // index into the problem's readings
  double size = 0;     // residual in standard deviations, all rows together (robust.h)
  double weight = 1;   // that a robust loss gave it
  std::string reason;  // "position off by 3.21 mm, 7.1 times the usual 0.45 mm"
};

// A reading is suspect when d^2 exceeds the 1 - 1e-6 quantile of chi-square for its rows (not one
// in a whole session of good readings), with the scale taken from the median of all, so that many
// bad readings do not hide each other. Largest first.
// @param weights of the readings; empty = all 1.
std::vector<Suspect> Suspects(const Problem& problem, const Estimate& estimate,
                              const ModelError& model_error, const std::vector<double>& weights);

}  // namespace truepose
