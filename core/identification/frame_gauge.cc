#include "core/identification/frame_gauge.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/rotation.h"
#include "core/identification/contacts.h"

namespace truepose {
namespace {

constexpr double kMostTurn_rad = 0.1;
constexpr int kMostSteps = 64;    // of 0.1 rad: further than any turn
constexpr double kThere = 1e-12;  // m or rad

bool IsFree(const std::vector<int>& free, int candidate) {
  return free.empty() || std::binary_search(free.begin(), free.end(), candidate);
}

// Whether a relation ties a coordinate of a target to candidates that all may move.
bool IsMovable(const Problem& problem, const std::vector<int>& free, const NullRelation& relation) {
  return relation.dropped >= problem.FirstOfTool(0) &&
         relation.dropped < problem.FirstOfOffsets() && !relation.kept.empty() &&
         IsFree(free, relation.dropped) &&
         std::all_of(relation.kept.begin(), relation.kept.end(),
                     [&](const auto& term) { return IsFree(free, term.first); });
}

// What a coordinate of a target lacks to its nominal value.
double Missing(const Problem& problem, const Estimate& estimate, const Pose& nominal,
               int candidate) {
  const int of_tools = candidate - problem.FirstOfTool(0);
  const Pose& X_FT = estimate.X_FT[of_tools / kFrameParameters];
  const int index = of_tools % kFrameParameters;
  if (index < 3) return nominal.p(index) - X_FT.p(index);
  const Eigen::Vector3d turn = LogRotation<double>(nominal.R * X_FT.R.transpose());
  return std::clamp(turn(index - 3), -kMostTurn_rad, kMostTurn_rad);
}

// @param x of all candidates that are not internal.
void Correct(const Problem& problem, const Eigen::VectorXd& x, Estimate* estimate) {
  for (int i = 0; i < problem.placement_count(); ++i) {
    Pose& X_MB = estimate->X_MB[i];
    X_MB = Corrected(X_MB, x.data() + problem.FirstOfBase(i), nullptr);
  }
  for (int i = 0; i < problem.target_count(); ++i) {
    Pose& X_FT = estimate->X_FT[i];
    X_FT = Corrected(X_FT, x.data() + problem.FirstOfTool(i), nullptr);
  }
  estimate->offsets += x.tail(estimate->offsets.size());
}

// @returns the largest coordinate moved.
double Step(const Problem& problem, const Pose& nominal, const std::vector<int>& free,
            const IdentifiabilityOptions& options, Estimate* estimate) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(problem.FirstInternal());
  double most = 0;
  for (const NullRelation& relation :
       FrameSet(problem, *estimate, ModelError{}, options).redundancies) {
    if (!IsMovable(problem, free, relation)) continue;
    const double missing = Missing(problem, *estimate, nominal, relation.dropped);
    most = std::max(most, std::abs(missing));
    x(relation.dropped) += missing;
    for (const auto& [kept, coefficient] : relation.kept) x(kept) -= missing * coefficient;
  }
  if (most > kThere) Correct(problem, x, estimate);
  return most;
}

}  // namespace

IdentifiableSet FrameSet(const Problem& problem, const Estimate& estimate,
                         const ModelError& model_error, IdentifiabilityOptions options) {
  ParameterSet external;
  const ParameterSet all = Candidates(problem);
  for (int i = 0; i < problem.FirstInternal(); ++i) external.Add(all[i]);
  options.use_sd_bounds = false;
  Estimate nominal = estimate;
  nominal.lambda.setZero();
  const Eigen::MatrixXd J = Whitened(AtContacts(problem, nominal), nominal, model_error).J;
  return Identifiable(J.leftCols(problem.FirstInternal()), external, options);
}

void SetFreeToolsToNominal(const Problem& problem, const Pose& X_FT_nominal,
                           const std::vector<int>& free, const IdentifiabilityOptions& options,
                           Estimate* estimate) {
  for (int i = 0; i < kMostSteps; ++i)
    if (Step(problem, X_FT_nominal, free, options, estimate) <= kThere) return;
}

}  // namespace truepose
