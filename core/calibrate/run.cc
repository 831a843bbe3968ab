#include "core/calibrate/run.h"

#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/calibrate/checks.h"
#include "core/models/build_model.h"

namespace truepose {
namespace {

// Frames that the scope holds must be known.
absl::StatusOr<StartOptions> StartOptionsOf(const CalibrationRun& run) {
  const Problem& part = run.part.problem;
  StartOptions start{run.problem.X_FT_nominal, NominalEstimate(part),
                     std::vector<bool>(part.placements.size(), false),
                     std::vector<bool>(part.targets.size(), false)};
  FaultList faults;
  for (size_t t = 0; t < part.targets.size() && !run.scope.tool; ++t) {
    if (!run.problem.X_FT_nominal)
      faults.Add("options.nominal_tool", "none", "the tool that calibrate = base holds");
    start.known.X_FT[t] = run.problem.X_FT_nominal.value_or(Pose{});
    start.tool_known[t] = true;
  }
  for (size_t p = 0; p < part.placements.size() && !run.scope.base; ++p) {
    const size_t whole = static_cast<size_t>(run.part.placements[p]);
    const bool known =
        whole < run.problem.X_MB_known.size() && run.problem.X_MB_known[whole].has_value();
    if (!known)
      faults.Add("options.prior_calibration",
                 "no base frame of placement '" + part.placements[p] + "'",
                 "a calibration with this placement: calibrate = tool holds its base");
    if (known) start.known.X_MB[p] = *run.problem.X_MB_known[whole];
    start.base_known[p] = true;
  }
  if (!faults.empty()) return faults.ToStatus();
  return start;
}

}  // namespace

std::vector<EffectGroup> ListedEffects(const CalibrateOptions& options) {
  return options.effects == EffectsMode::kListed ? options.effect_groups
                                                 : std::vector<EffectGroup>{};
}

absl::StatusOr<Model> ModelOf(const CalibrationProblem& problem, const CalibrateOptions& options,
                              const std::vector<EffectGroup>& effects) {
  TRUEPOSE_ASSIGN_OR_RETURN(Model model,
                            BuildModel(options.model, *problem.robot, ModelExtent::kInternal));
  for (EffectGroup group : effects) AddEffects(*problem.robot, group, &model);
  return model;
}

bool HoldsTheRest(const CalibrateOptions& options) {
  return options.prior == PriorKind::kStored && IsPartial(options.calibrate);
}

absl::Status Prepare(const Model& model, CalibrationRun* run) {
  const CalibrateOptions& options = run->options;
  run->part.problem.prior.reset();
  run->start_lambda = Eigen::VectorXd::Zero(model.parameters.size());
  if (options.prior == PriorKind::kTolerance)
    run->part.problem.prior = PriorOf(options.tolerance, model.parameters);
  if (options.prior == PriorKind::kStored) {
    TRUEPOSE_RETURN_IF_ERROR(CheckConvention(*options.stored, model));
    TRUEPOSE_ASSIGN_OR_RETURN(Prior prior, PriorOf(*options.stored, model.parameters));
    run->start_lambda = prior.mean;
    if (HoldsTheRest(options)) {
      run->identify.known_model_error = options.stored->model_error;
    } else {
      run->part.problem.prior = std::move(prior);
    }
  }
  if (!run->part.problem.prior && !model.effects.empty() && !HoldsTheRest(options))
    run->part.problem.prior = NoPrior(model.parameters);
  if (run->part.problem.prior) AddEffectPrior(model.parameters, &*run->part.problem.prior);
  TRUEPOSE_ASSIGN_OR_RETURN(run->scope, ScopeOf(options.calibrate, run->part.problem));
  run->identify.free = run->scope.free;
  return absl::OkStatus();
}

absl::Status FindBefore(CalibrationRun* run, Identification* before) {
  TRUEPOSE_ASSIGN_OR_RETURN(const StartOptions options, StartOptionsOf(*run));
  TRUEPOSE_ASSIGN_OR_RETURN(Estimate start, FindStart(run->part.problem, options,
                                                      run->stages.For("start_values", 0, 0.1)));
  start.lambda = run->start_lambda;
  TRUEPOSE_RETURN_IF_ERROR(
      CheckJointSpace(*run->problem.robot, run->part.problem, start, run->identify));
  TRUEPOSE_ASSIGN_OR_RETURN(*before, FitFrames(run->part.problem, start, run->identify,
                                               run->stages.For("start_values", 0.1, 0.3)));
  return absl::OkStatus();
}

}  // namespace truepose
