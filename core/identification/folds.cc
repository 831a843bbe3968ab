#include "core/identification/folds.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/random.h"
#include "core/identification/identifiability.h"
#include "core/identification/prediction.h"

namespace truepose {
namespace {

void NumberUnits(const std::vector<int>& units, Folds* folds) {
  std::map<int, int> known;
  for (int unit : units)
    folds->unit_of.push_back(known.emplace(unit, static_cast<int>(known.size())).first->second);
  folds->unit_count = static_cast<int>(known.size());
}

absl::Status CheckCounts(int readings, size_t units, const Folds& folds) {
  FaultList faults;
  if (static_cast<int>(units) != readings)
    faults.Add("units", absl::StrCat(units),
               absl::StrCat("one for each of ", readings, " readings"));
  if (folds.count < 2) faults.Add("folds", absl::StrCat(folds.count), "at least 2");
  if (folds.count > folds.unit_count)
    faults.Add("folds", absl::StrCat(folds.count),
               absl::StrCat("at most the ", folds.unit_count, " units of readings"));
  return faults.ToStatus();
}

int RankOf(const Problem& problem, const ModelError& model_error, const Estimate& estimate,
           const std::vector<int>& active) {
  const ParameterSet all = Candidates(problem);
  ParameterSet names;
  for (int candidate : active) names.Add(all[candidate]);
  IdentifiabilityOptions options;
  options.use_sd_bounds = false;
  const Eigen::MatrixXd J = Whitened(problem, estimate, model_error).J(Eigen::all, active);
  return static_cast<int>(Identifiable(J, names, options).active.size());
}

}  // namespace

Folds DealFolds(const Units& units, int count, uint64_t seed) {
  Folds folds{units.of, units.count, std::vector<int>(static_cast<size_t>(units.count)), count};
  const std::vector<int> order = Shuffled(units.count, seed);
  for (int i = 0; i < units.count; ++i) folds.fold_of[order[i]] = i % count;
  return folds;
}

absl::StatusOr<Folds> DealFolds(int readings, const std::vector<int>& units, int count,
                                uint64_t seed) {
  std::vector<int> all = units;
  if (all.empty()) {
    all.resize(readings);
    std::iota(all.begin(), all.end(), 0);
  }
  Folds folds;
  folds.count = count;
  NumberUnits(all, &folds);
  if (absl::Status status = CheckCounts(readings, all.size(), folds); !status.ok()) return status;
  return DealFolds(Units{folds.unit_of, folds.unit_count}, count, seed);
}

Problem Without(const Problem& problem, const Folds& folds, int fold) {
  Problem part = problem;
  part.readings.clear();
  for (size_t i = 0; i < problem.readings.size(); ++i) {
    if (folds.fold_of[folds.unit_of[i]] != fold) part.readings.push_back(problem.readings[i]);
  }
  return part;
}

absl::Status CheckFolds(const Problem& problem, const ModelError& model_error,
                        const Estimate& estimate, const std::vector<int>& active,
                        const Folds& folds) {
  FaultList faults;
  for (int fold = 0; fold < folds.count; ++fold) {
    const int rank = RankOf(Without(problem, folds, fold), model_error, estimate, active);
    if (rank == static_cast<int>(active.size())) continue;
    faults.Add("options.select",
               absl::StrCat("without fold ", fold + 1, " of ", folds.count,
                            " the readings determine ", rank, " of ", active.size(), " parameters"),
               "more rows of every placement and target, or a choice without folds (none, forward, "
               "bic)");
  }
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

void AddHeldOut(const Problem& problem, const Whiteners& whiteners, const Estimate& estimate,
                const Folds& folds, int fold, Eigen::VectorXd* sums) {
  for (size_t i = 0; i < problem.readings.size(); ++i) {
    const int unit = folds.unit_of[i];
    if (folds.fold_of[unit] != fold) continue;
    (*sums)(unit) +=
        (whiteners[i] * ResidualAt(problem, problem.readings[i], estimate)).squaredNorm();
  }
}

}  // namespace truepose
