#include "core/identification/start_values.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/identification/start_pair.h"

namespace truepose {
namespace {

// The part of the problem with one placement and one target. @param offsets which of the whole each
// of the pair's offsets is.
Problem PairProblem(const Problem& problem, int placement, int target, std::vector<int>* offsets) {
  Problem pair{problem.model, {}, {""}, {""}};
  for (const Reading& reading : problem.readings) {
    if (reading.placement != placement || reading.target != target) continue;
    pair.readings.push_back(reading);
    Reading& last = pair.readings.back();
    last.placement = last.target = 0;
    if (reading.offset < 0) continue;
    const auto it = std::find(offsets->begin(), offsets->end(), reading.offset);
    last.offset = static_cast<int>(it - offsets->begin());
    if (it == offsets->end()) offsets->push_back(reading.offset);
  }
  pair.offsets.resize(offsets->size());
  return pair;
}

// Spreads from known frames to those that share readings with them.
class Spreader {
 public:
  Spreader(const Problem& problem, const StartOptions& options)
      : problem_(problem),
        options_(options),
        estimate_(NominalEstimate(problem)),
        counts_(problem.placement_count(), std::vector<int>(problem.target_count(), 0)),
        base_known_(problem.placement_count(), false),
        tool_known_(problem.target_count(), false),
        offsets_(problem.offsets.size()) {
    for (const Reading& reading : problem.readings)
      counts_[reading.placement][reading.target] += RowsOf(reading);
    for (size_t k = 0; k < options.offset_known.size(); ++k) {
      if (options.offset_known[k])
        offsets_[k] = options.known.offsets(static_cast<Eigen::Index>(k));
    }
    for (size_t p = 0; p < options.base_known.size(); ++p) {
      if (options.base_known[p]) estimate_.X_MB[p] = options.known.X_MB[p], base_known_[p] = true;
    }
    for (size_t t = 0; t < options.tool_known.size(); ++t) {
      if (options.tool_known[t]) estimate_.X_FT[t] = options.known.X_FT[t], tool_known_[t] = true;
    }
  }

  // Solves the pair with the most measured values that touches a known frame, else the largest of
  // all, until all frames are known.
  absl::StatusOr<Estimate> Run(const Hooks& hooks) {
    while (std::count(base_known_.begin(), base_known_.end(), false) +
               std::count(tool_known_.begin(), tool_known_.end(), false) >
           0) {
      if (hooks.Cancelled()) return absl::CancelledError("cancelled");
      const auto [placement, target] = NextPair();
      if (placement < 0) return Unseen();
      Solve(placement, target);
    }
    SetOffsets(problem_, offsets_, &estimate_);
    return estimate_;
  }

 private:
  std::pair<int, int> NextPair() const {
    std::pair<int, int> best = {-1, -1};
    long best_score = 0;
    for (int p = 0; p < problem_.placement_count(); ++p) {
      for (int t = 0; t < problem_.target_count(); ++t) {
        if (base_known_[p] && tool_known_[t]) continue;
        const bool touches = base_known_[p] || tool_known_[t];
        const long score = counts_[p][t] + (touches && counts_[p][t] > 0 ? long{1} << 40 : 0);
        if (score > best_score) best = {p, t}, best_score = score;
      }
    }
    return best;
  }

  void Solve(int p, int t) {
    std::vector<int> offsets;
    const Problem pair = PairProblem(problem_, p, t, &offsets);
    PairKnown known;
    if (base_known_[p]) known.X_MB = estimate_.X_MB[p];
    if (tool_known_[t]) known.X_FT = estimate_.X_FT[t];
    for (int offset : offsets) known.offsets.push_back(offsets_[offset]);
    const Estimate found = SolvePair(pair, known, options_.X_FT);
    estimate_.X_MB[p] = found.X_MB[0];
    estimate_.X_FT[t] = found.X_FT[0];
    for (size_t k = 0; k < offsets.size(); ++k)
      offsets_[offsets[k]] = found.offsets(static_cast<Eigen::Index>(k));
    base_known_[p] = tool_known_[t] = true;
  }

  absl::Status Unseen() const {
    FaultList faults;
    for (int p = 0; p < problem_.placement_count(); ++p) {
      if (!base_known_[p])
        faults.Add(absl::StrCat("placement '", problem_.placements[p], "'"), "no usable reading",
                   "at least one");
    }
    for (int t = 0; t < problem_.target_count(); ++t) {
      if (!tool_known_[t])
        faults.Add(absl::StrCat("target '", problem_.targets[t], "'"), "no usable reading",
                   "at least one");
    }
    return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
  }

  const Problem& problem_;
  const StartOptions& options_;
  Estimate estimate_;
  std::vector<std::vector<int>> counts_;  // of measured values
  std::vector<bool> base_known_, tool_known_;
  std::vector<std::optional<double>> offsets_;
};

}  // namespace

absl::StatusOr<Estimate> FindStart(const Problem& problem, const StartOptions& options,
                                   const Hooks& hooks) {
  return Spreader(problem, options).Run(hooks);
}

}  // namespace truepose
