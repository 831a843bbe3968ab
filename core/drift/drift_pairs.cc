#include "core/drift/drift_pairs.h"

#include <algorithm>
#include <cmath>

namespace truepose {
namespace {

constexpr double kChanged = 0.01, kBeyond = 0.001, kLeastLead = 2;

struct Pair {
  size_t a, b;
  DriftFit fit;
  double drop;
  int freedom;
  double bic;
};

Pair FitPair(const DriftFitter& fitter, const SingleFits& fits, size_t a, size_t b) {
  Pair pair{a, b, {}, 0, 0, 0};
  pair.fit = fitter.Fit(fits.legitimate + fits.parts[a].freedom + fits.parts[b].freedom);
  pair.drop = std::max(0.0, fits.none.chi_square - pair.fit.chi_square);
  pair.freedom = pair.fit.rank - fits.none.rank;
  pair.bic = -pair.drop / fits.sums.Scale() +
             pair.freedom * std::log(static_cast<double>(pair.fit.whitened.size()));
  return pair;
}

// Likeliest first.
std::vector<Pair> FitPairs(const DriftFitter& fitter, const SingleFits& fits) {
  std::vector<Pair> pairs;
  for (size_t a = 0; a < fits.parts.size(); ++a)
    for (size_t b = a + 1; b < fits.parts.size(); ++b) pairs.push_back(FitPair(fitter, fits, a, b));
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& x, const Pair& y) { return x.bic < y.bic; });
  return pairs;
}

// Whether both take part, each beyond what the other explains.
bool NeedsBoth(const SingleFits& fits, const Pair& pair, size_t pairs) {
  for (const size_t one : {pair.a, pair.b}) {
    const DriftFit& alone = fits.of_parts[one];
    const double more = alone.chi_square - pair.fit.chi_square;
    const int freedom = pair.fit.rank - alone.rank;
    if (DropProbability(fits.sums, more, freedom) * static_cast<double>(pairs) >= kChanged)
      return false;
  }
  return true;
}

bool LeavesMore(const SingleFits& fits, const Pair& pair) {
  return DropProbability(fits.sums, fits.sums.drop - pair.drop,
                         fits.sums.drop_freedom - pair.freedom) < kBeyond;
}

DriftPart PartIn(const DriftProblem& problem, const SingleFits& fits, const Pair& pair, size_t i) {
  const auto size = [&](size_t part) {
    return static_cast<Eigen::Index>(fits.parts[part].freedom.candidates.size());
  };
  const auto legitimate = static_cast<Eigen::Index>(fits.legitimate.candidates.size());
  const Eigen::Index first = legitimate + (i == pair.b ? size(pair.a) : 0);
  DriftPart part;
  part.name = fits.parts[i].name;
  SetChange(problem, fits.parts[i], pair.fit.changes.segment(first, size(i)), pair.fit.joints,
            &part);
  return part;
}

}  // namespace

std::optional<std::vector<DriftPart>> ChangedTogether(const DriftProblem& problem,
                                                      const DriftFitter& fitter,
                                                      const SingleFits& fits) {
  const std::vector<Pair> pairs = FitPairs(fitter, fits);
  if (pairs.empty() || LeavesMore(fits, pairs[0])) return std::nullopt;
  if (!NeedsBoth(fits, pairs[0], pairs.size())) return std::nullopt;
  if (pairs.size() > 1 && pairs[1].bic - pairs[0].bic < kLeastLead) return std::nullopt;
  return std::vector<DriftPart>{PartIn(problem, fits, pairs[0], pairs[0].a),
                                PartIn(problem, fits, pairs[0], pairs[0].b)};
}

}  // namespace truepose
