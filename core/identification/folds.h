// Folds of cross-validation: parts of the readings that are predicted by the fit to the others.
#pragma once

#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "core/identification/weights.h"

namespace truepose {

struct Folds {
  std::vector<int> unit_of;  // 0 .. unit_count - 1 for each reading, in the order of first reading
  int unit_count = 0;
  std::vector<int> fold_of;  // for each unit
  int count = 0;
};

// Deals the units, shuffled by the seed, to the folds in turn. @param count 1 .. units.count, or 1
// where there is no unit.
Folds DealFolds(const Units& units, int count, uint64_t seed);

// The same with checks. Deals the units, shuffled by the seed, to the folds in turn. @param units
// one a reading or empty.
// @returns kInvalidArgument when there are fewer units than folds or fewer than two folds.
absl::StatusOr<Folds> DealFolds(int readings, const std::vector<int>& units, int count,
                                uint64_t seed);

// The problem without the readings of a fold.
Problem Without(const Problem& problem, const Folds& folds, int fold);

// @returns kFailedPrecondition with a fault for each fold without which `active`, independent on
// all readings, is dependent at the estimate.
absl::Status CheckFolds(const Problem& problem, const ModelError& model_error,
                        const Estimate& estimate, const std::vector<int>& active,
                        const Folds& folds);

// Adds to each unit of a fold the sum of squares of its whitened residuals at an estimate.
// @param sums unit_count values.
void AddHeldOut(const Problem& problem, const Whiteners& whiteners, const Estimate& estimate,
                const Folds& folds, int fold, Eigen::VectorXd* sums);

}  // namespace truepose
