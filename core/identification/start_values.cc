#include "core/identification/start_values.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/identification/prediction.h"
#include "core/identification/solve.h"
#include "core/identification/start_candidates.h"

namespace truepose {
namespace {

constexpr int kReadingsToTry = 60;
constexpr int kStartsToRefine = 12;
// A robot that is off by millimetres and a tenth of a degree; only the ratio matters here.
constexpr ModelError kStartWeights = {2e-3, 3e-3};

// The part of the problem with one placement and one target.
Problem PairProblem(const Problem& problem, int placement, int target, int most) {
  Problem pair{problem.model, {}, {""}, {""}};
  for (const Reading& reading : problem.readings) {
    if (reading.placement == placement && reading.target == target)
      pair.readings.push_back(reading);
  }
  const int count = static_cast<int>(pair.readings.size());
  if (count > most) {
    std::vector<Reading> spaced;
    for (int i = 0; i < most; ++i)
      spaced.push_back(pair.readings[static_cast<size_t>(i) * count / most]);
    pair.readings = std::move(spaced);
  }
  for (Reading& reading : pair.readings) reading.placement = reading.target = 0;
  return pair;
}

std::vector<NominalReading> WithNominal(const Problem& problem) {
  const Eigen::VectorXd nominal = Eigen::VectorXd::Zero(problem.model->parameters.size());
  std::vector<NominalReading> readings;
  for (const Reading& reading : problem.readings) {
    readings.push_back({&reading, Forward(*problem.model, reading.q, nominal, reading.conditions)});
  }
  return readings;
}

double StartCost(const Problem& problem, const Estimate& estimate) {
  return CostOf(problem, estimate, WhitenersOf(problem, estimate, kStartWeights));
}

Estimate EstimateOf(const Problem& problem, const FramePair& pair) {
  Estimate estimate = NominalEstimate(problem);
  estimate.X_MB[0] = pair.X_MB;
  estimate.X_FT[0] = pair.X_FT;
  return estimate;
}

struct Start {
  double cost;
  Estimate estimate;
};

bool ByCost(const Start& a, const Start& b) { return a.cost < b.cost; }

std::vector<Start> BestStarts(const Problem& problem, const std::optional<Pose>& X_FT) {
  std::vector<Start> starts;
  for (const FramePair& pair : StartCandidates(WithNominal(problem), X_FT)) {
    Estimate estimate = EstimateOf(problem, pair);
    starts.push_back({StartCost(problem, estimate), std::move(estimate)});
  }
  std::stable_sort(starts.begin(), starts.end(), ByCost);
  if (starts.size() > kStartsToRefine) starts.resize(kStartsToRefine);
  return starts;
}

double Refine(const Problem& problem, Estimate* estimate) {
  SolveOptions options;
  options.max_iterations = 50;
  options.function_tolerance = 1e-9;
  Solve(problem, kStartWeights, ExternalCandidates(problem), options, Hooks{}, estimate);
  return StartCost(problem, *estimate);
}

// Both frames of a pair of which nothing is known.
FramePair SolvePair(const Problem& problem, int placement, int target,
                    const std::optional<Pose>& X_FT) {
  const Problem few = PairProblem(problem, placement, target, kReadingsToTry);
  std::vector<Start> starts = BestStarts(few, X_FT);
  for (Start& start : starts) start.cost = Refine(few, &start.estimate);
  Start& best = *std::min_element(starts.begin(), starts.end(), ByCost);
  Refine(PairProblem(problem, placement, target, static_cast<int>(problem.readings.size())),
         &best.estimate);
  return {best.estimate.X_MB[0], best.estimate.X_FT[0]};
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
        tool_known_(problem.target_count(), false) {
    for (const Reading& reading : problem.readings) ++counts_[reading.placement][reading.target];
    for (size_t p = 0; p < options.base_known.size(); ++p) {
      if (options.base_known[p]) estimate_.X_MB[p] = options.known.X_MB[p], base_known_[p] = true;
    }
    for (size_t t = 0; t < options.tool_known.size(); ++t) {
      if (options.tool_known[t]) estimate_.X_FT[t] = options.known.X_FT[t], tool_known_[t] = true;
    }
  }

  // Solves the largest pair that touches a known frame, else the largest of all, until all frames
  // are known.
  absl::StatusOr<Estimate> Run(const Hooks& hooks) {
    while (std::count(base_known_.begin(), base_known_.end(), false) +
               std::count(tool_known_.begin(), tool_known_.end(), false) >
           0) {
      if (hooks.Cancelled()) return absl::CancelledError("cancelled");
      const auto [placement, target] = NextPair();
      if (placement < 0) return Unseen();
      Solve(placement, target);
    }
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
    const Problem pair = PairProblem(problem_, p, t, static_cast<int>(problem_.readings.size()));
    if (tool_known_[t]) {
      estimate_.X_MB[p] = BaseFromTool(WithNominal(pair), estimate_.X_FT[t]);
    } else if (base_known_[p]) {
      estimate_.X_FT[t] = ToolFromBase(WithNominal(pair), estimate_.X_MB[p]);
    } else {
      const FramePair frames = SolvePair(problem_, p, t, options_.X_FT);
      estimate_.X_MB[p] = frames.X_MB;
      estimate_.X_FT[t] = frames.X_FT;
    }
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
  std::vector<std::vector<int>> counts_;
  std::vector<bool> base_known_, tool_known_;
};

}  // namespace

absl::StatusOr<Estimate> FindStart(const Problem& problem, const StartOptions& options,
                                   const Hooks& hooks) {
  return Spreader(problem, options).Run(hooks);
}

}  // namespace truepose
