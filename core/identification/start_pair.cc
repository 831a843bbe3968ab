#include "core/identification/start_pair.h"

#include <algorithm>
#include <tuple>

#include "core/identification/prediction.h"
#include "core/identification/solve.h"
#include "core/identification/start_candidates.h"
#include "core/identification/start_partial.h"

namespace truepose {
namespace {

constexpr size_t kReadingsToTry = 60;
constexpr size_t kStartsToRefine = 12;
// Enough to align the base for any target position.
constexpr size_t kEnoughPoints = 4;
// A robot that is off by millimetres and a tenth of a degree; only the ratio matters here.
constexpr ModelError kStartWeights = {2e-3, 3e-3};

using Readings = std::vector<NominalReading>;

bool AllShowPoints(const Problem& pair) {
  return std::all_of(pair.readings.begin(), pair.readings.end(), ShowsPoint);
}

// Sorts, anchors, and planes with their heights side by side, so that evenly spaced readings have
// some of each, whatever the order they were measured in.
bool BySort(const Reading& a, const Reading& b) {
  const auto key = [](const Reading& r) {
    const double height =
        r.kind == ObservationKind::kPlane ? r.normal_M.dot(r.X_MT.p) : r.anchor_M.x();
    return std::tuple(r.kind, r.offset, r.coordinates, r.anchor_M.x(), r.anchor_M.y(),
                      r.anchor_M.z(), r.normal_M.x(), r.normal_M.y(), r.normal_M.z(), height);
  };
  return key(a) < key(b);
}

Problem Thinned(const Problem& pair) {
  const size_t count = pair.readings.size();
  if (count <= kReadingsToTry) return pair;
  Problem few = pair;
  if (!AllShowPoints(pair)) std::stable_sort(few.readings.begin(), few.readings.end(), BySort);
  for (size_t i = 0; i < kReadingsToTry; ++i)
    few.readings[i] = few.readings[i * count / kReadingsToTry];
  few.readings.resize(kReadingsToTry);
  return few;
}

Readings WithNominal(const Problem& problem) {
  const Eigen::VectorXd nominal = Eigen::VectorXd::Zero(problem.model->parameters.size());
  Readings readings;
  for (const Reading& reading : problem.readings) {
    readings.push_back({&reading, Forward(*problem.model, reading.q, nominal, reading.conditions)});
  }
  return readings;
}

Readings ThatShowPoints(Readings readings) {
  std::erase_if(readings, [](const NominalReading& r) { return !ShowsPoint(*r.reading); });
  return readings;
}

double StartCost(const Problem& problem, const Estimate& estimate) {
  return CostOf(problem, estimate, WhitenersOf(problem, estimate, kStartWeights));
}

struct Start {
  double cost;
  Estimate estimate;
};

bool ByCost(const Start& a, const Start& b) { return a.cost < b.cost; }

std::vector<Eigen::Vector3d> PositionsToTry(const std::optional<Pose>& X_FT) {
  std::vector<Eigen::Vector3d> positions = ToolPositions();
  if (X_FT.has_value()) positions.insert(positions.begin(), X_FT->p);
  return positions;
}

std::vector<FramePair> WithKnownTool(const Readings& readings, const Pose& X_FT) {
  const Readings points = ThatShowPoints(readings);
  std::vector<FramePair> pairs;
  if (points.size() >= kEnoughPoints || points.size() == readings.size())
    pairs.push_back({BaseFromTool(points, X_FT), X_FT});
  if (points.size() == readings.size()) return pairs;
  for (const Pose& X_MB : BasesFromToolPosition(readings, X_FT.p)) pairs.push_back({X_MB, X_FT});
  return pairs;
}

std::vector<FramePair> WithKnownBase(const Readings& readings, const Pose& X_MB) {
  const Readings points = ThatShowPoints(readings);
  if (points.size() == readings.size()) return {{X_MB, ToolFromBase(points, X_MB)}};
  const Eigen::Matrix3d R_FT = AverageToolRotation(readings, X_MB.R);
  std::vector<FramePair> pairs;
  for (const Eigen::Vector3d& p_FT : ToolPositionsFromBase(readings, X_MB))
    pairs.push_back({X_MB, {R_FT, p_FT}});
  return pairs;
}

std::vector<FramePair> WithNothingKnown(const Readings& readings, const std::optional<Pose>& X_FT) {
  const Readings points = ThatShowPoints(readings);
  if (points.size() == readings.size() || points.size() >= kEnoughPoints)
    return StartCandidates(points, X_FT);
  std::vector<FramePair> pairs;
  for (const Eigen::Vector3d& p_FT : PositionsToTry(X_FT)) {
    for (const Pose& X_MB : BasesFromToolPosition(readings, p_FT))
      pairs.push_back({X_MB, {AverageToolRotation(readings, X_MB.R), p_FT}});
  }
  return pairs;
}

std::vector<FramePair> Guesses(const Problem& pair, const PairKnown& known,
                               const std::optional<Pose>& X_FT) {
  const Readings readings = WithNominal(pair);
  if (known.X_FT) return WithKnownTool(readings, *known.X_FT);
  if (known.X_MB) return WithKnownBase(readings, *known.X_MB);
  return WithNothingKnown(readings, X_FT);
}

std::vector<Start> BestStarts(const Problem& pair, const PairKnown& known,
                              const std::optional<Pose>& X_FT) {
  std::vector<Start> starts;
  for (const FramePair& frames : Guesses(pair, known, X_FT)) {
    Estimate estimate = NominalEstimate(pair);
    estimate.X_MB[0] = frames.X_MB;
    estimate.X_FT[0] = frames.X_FT;
    SetOffsets(pair, known.offsets, &estimate);
    starts.push_back({StartCost(pair, estimate), std::move(estimate)});
  }
  std::stable_sort(starts.begin(), starts.end(), ByCost);
  if (starts.size() > kStartsToRefine) starts.resize(kStartsToRefine);
  return starts;
}

std::vector<int> Unknown(const Problem& pair, const PairKnown& known) {
  std::vector<int> unknown;
  for (int i = 0; i < kFrameParameters && !known.X_MB; ++i)
    unknown.push_back(pair.FirstOfBase(0) + i);
  for (int i = 0; i < kFrameParameters && !known.X_FT; ++i)
    unknown.push_back(pair.FirstOfTool(0) + i);
  for (size_t k = 0; k < known.offsets.size(); ++k) {
    if (!known.offsets[k]) unknown.push_back(pair.FirstOfOffsets() + static_cast<int>(k));
  }
  return unknown;
}

double Refine(const Problem& pair, const PairKnown& known, Estimate* estimate) {
  SolveOptions options;
  options.max_iterations = 50;
  options.function_tolerance = 1e-9;
  Solve(pair, kStartWeights, Unknown(pair, known), options, Hooks{}, estimate);
  return StartCost(pair, *estimate);
}

}  // namespace

Estimate SolvePair(const Problem& pair, const PairKnown& known, const std::optional<Pose>& X_FT) {
  const bool linear = AllShowPoints(pair) && (known.X_MB || known.X_FT);
  const Problem few = linear ? pair : Thinned(pair);
  std::vector<Start> starts = BestStarts(few, known, X_FT);
  if (linear) return starts.front().estimate;
  for (Start& start : starts) start.cost = Refine(few, known, &start.estimate);
  Start& best = *std::min_element(starts.begin(), starts.end(), ByCost);
  Refine(pair, known, &best.estimate);
  return best.estimate;
}

void SetOffsets(const Problem& problem, const std::vector<std::optional<double>>& known,
                Estimate* estimate) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(estimate->offsets.size()), counts = sums;
  estimate->offsets.setZero();
  for (const Reading& reading : problem.readings) {
    if (reading.offset < 0) continue;
    sums(reading.offset) += ResidualAt(problem, reading, *estimate)(0);
    counts(reading.offset) += 1;
  }
  estimate->offsets = sums.cwiseQuotient(counts.cwiseMax(1));
  for (size_t k = 0; k < known.size(); ++k) {
    if (known[k]) estimate->offsets(static_cast<Eigen::Index>(k)) = *known[k];
  }
}

}  // namespace truepose
