#include "core/calibrate/preview.h"

#include "core/base/status_macros.h"
#include "core/calibrate/checks.h"
#include "core/calibrate/run.h"

namespace truepose {

absl::StatusOr<CalibrationPreview> PreviewCalibration(const CalibrationProblem& problem,
                                                      const CalibrateOptions& options,
                                                      const Hooks& hooks) {
  TRUEPOSE_RETURN_IF_ERROR(CheckProblem(problem));
  const std::vector<EffectGroup> effects = ListedEffects(options);
  CalibrationPreview preview;
  TRUEPOSE_ASSIGN_OR_RETURN(preview.model, ModelOf(problem, options, effects));
  CalibrationRun run{problem,
                     options,
                     StagedHooks(hooks),
                     PartOf(problem, preview.model, problem.calibrates),
                     options.identify,
                     {},
                     {}};
  TRUEPOSE_RETURN_IF_ERROR(CheckEffects(*problem.robot, run.part.problem, effects));
  TRUEPOSE_RETURN_IF_ERROR(Prepare(preview.model, &run));
  Identification before;
  TRUEPOSE_RETURN_IF_ERROR(FindBefore(&run, &before));
  const Problem& part = run.part.problem;
  const IdentifiableSet generic = GenericIdentifiable(part, *problem.robot);
  preview.generic_rank = static_cast<int>(generic.active.size());
  preview.counts = CountParameters(*problem.robot, part, generic);
  preview.candidates = Candidates(part);
  TRUEPOSE_ASSIGN_OR_RETURN(preview.set, IdentifiableAtStart(part, generic, before, run.identify));
  if (options.require_complete)
    TRUEPOSE_RETURN_IF_ERROR(CheckComplete(preview.set, preview.candidates));
  return preview;
}

}  // namespace truepose
