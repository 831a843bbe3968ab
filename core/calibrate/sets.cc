#include "core/calibrate/sets.h"

#include <algorithm>

#include "core/base/status_macros.h"

namespace truepose {
namespace {

// The part's index of a whole's index, appended when new.
int Renumbered(int whole, std::vector<int>* known) {
  const auto it = std::find(known->begin(), known->end(), whole);
  if (it != known->end()) return static_cast<int>(it - known->begin());
  known->push_back(whole);
  return static_cast<int>(known->size()) - 1;
}

std::vector<std::string> LabelsOf(const std::vector<int>& indices,
                                  const std::vector<std::string>& labels) {
  std::vector<std::string> result;
  for (int index : indices) result.push_back(labels[index]);
  return result;
}

void Place(const std::vector<int>& indices, const std::vector<Pose>& frames,
           std::vector<Pose>* whole, std::vector<bool>* known, std::vector<FittedOn>* fitted_on) {
  for (size_t i = 0; i < indices.size(); ++i) {
    (*whole)[indices[i]] = frames[i];
    (*known)[indices[i]] = true;
    (*fitted_on)[indices[i]] = FittedOn::kCalibrationRows;
  }
}

// Candidates of the frames and constants that are not known.
std::vector<int> UnknownFrames(const Problem& problem, const StartOptions& options,
                               const std::vector<int>& known_offsets) {
  std::vector<int> active;
  const auto add = [&](int first) {
    for (int i = 0; i < kFrameParameters; ++i) active.push_back(first + i);
  };
  for (int p = 0; p < problem.placement_count(); ++p) {
    if (!options.base_known[p]) add(problem.FirstOfBase(p));
  }
  for (int t = 0; t < problem.target_count(); ++t) {
    if (!options.tool_known[t]) add(problem.FirstOfTool(t));
  }
  for (int i = 0; i < static_cast<int>(problem.offsets.size()); ++i) {
    if (std::find(known_offsets.begin(), known_offsets.end(), i) == known_offsets.end())
      active.push_back(problem.FirstOfOffsets() + i);
  }
  return active;
}

}  // namespace

Part PartOf(const CalibrationProblem& whole, const Model& model, const std::vector<bool>& chosen) {
  Part part;
  part.problem.model = &model;
  for (size_t i = 0; i < whole.readings.size(); ++i) {
    if (!chosen[i]) continue;
    Reading reading = whole.readings[i];
    reading.placement = Renumbered(reading.placement, &part.placements);
    reading.target = Renumbered(reading.target, &part.targets);
    if (reading.offset >= 0) reading.offset = Renumbered(reading.offset, &part.offsets);
    part.problem.readings.push_back(std::move(reading));
  }
  part.problem.placements = LabelsOf(part.placements, whole.placements);
  part.problem.targets = LabelsOf(part.targets, whole.targets);
  part.problem.offsets = LabelsOf(part.offsets, whole.offsets);
  return part;
}

Problem WholeProblem(const CalibrationProblem& whole, const Model& model) {
  return {&model, whole.readings, whole.placements, whole.targets, whole.offsets};
}

absl::StatusOr<WholeFrames> FramesOfWhole(const CalibrationProblem& whole, const Model& model,
                                          const Part& part, const Identification& of_part,
                                          const Hooks& hooks) {
  const Problem problem = WholeProblem(whole, model);
  WholeFrames frames;
  frames.estimate = NominalEstimate(problem);
  StartOptions options{whole.X_FT_nominal, NominalEstimate(problem),
                       std::vector<bool>(problem.placement_count(), false),
                       std::vector<bool>(problem.target_count(), false)};
  frames.base_fitted_on.assign(problem.placement_count(), FittedOn::kOwnRows);
  frames.tool_fitted_on.assign(problem.target_count(), FittedOn::kOwnRows);
  Place(part.placements, of_part.estimate.X_MB, &options.known.X_MB, &options.base_known,
        &frames.base_fitted_on);
  Place(part.targets, of_part.estimate.X_FT, &options.known.X_FT, &options.tool_known,
        &frames.tool_fitted_on);
  TRUEPOSE_ASSIGN_OR_RETURN(frames.estimate, FindStart(problem, options, hooks));
  frames.estimate.lambda = of_part.estimate.lambda;
  for (size_t i = 0; i < part.offsets.size(); ++i)
    frames.estimate.offsets(part.offsets[i]) = of_part.estimate.offsets(static_cast<int>(i));
  const std::vector<int> unknown = UnknownFrames(problem, options, part.offsets);
  if (!unknown.empty())
    Solve(problem, of_part.model_error, unknown, SolveOptions{}, hooks, &frames.estimate);
  return frames;
}

}  // namespace truepose
