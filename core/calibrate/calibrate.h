// The one function that a calibration job calls; usable without the server.
//
//   readings with roles -> start values -> "before" (base and tool alone, nominal lambda, or that
//   of an earlier calibration; calibration rows)
//   -> identification on the calibration rows [-> choice of parameters or joint effects, by the
//   calibration rows alone -> identification] -> control and complete sets, before and after ->
//   verdict
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/assessment/accuracy.h"
#include "core/assessment/places.h"
#include "core/assessment/statistics.h"
#include "core/assessment/suspects.h"
#include "core/assessment/verdict.h"
#include "core/calibrate/change.h"
#include "core/calibrate/effect_choice.h"
#include "core/conversion/counts.h"
#include "core/identification/identify.h"
#include "core/identification/prior.h"
#include "core/identification/selection.h"

namespace truepose {

struct CalibrationProblem {
  const Robot* robot = nullptr;   // not owned
  std::vector<Reading> readings;  // all usable rows
  std::vector<bool> calibrates;   // a role for each reading; the others control
  std::vector<std::string> placements, targets;
  std::vector<std::string> offsets = {};  // labels of the unknown constants of distances
  std::optional<Pose> X_FT_nominal;       // of the target, tried first as start value
  // Frames of an earlier calibration, where they are known: for options that hold them.
  std::vector<std::optional<Pose>> X_MB_known = {};  // empty, or one a placement
  // Chain joints of the readings by another source than their q (commanded beside measured), to be
  // compared with them; of size 0 where there are none. Empty, or one a reading.
  std::vector<Eigen::VectorXd> other_q = {};
};

enum class PriorKind { kNone, kTolerance, kStored };
enum class EffectsMode { kNone, kAuto, kListed };

struct CalibrateOptions {
  IdentifyOptions identify;
  // Dependent directions beyond those that no readings could determine are an error.
  bool require_complete = false;
  std::string model = "modified_incremental";  // models/build_model.h
  std::optional<SelectionOptions> select;      // of geometric parameters; none = all that show
  EffectsMode effects = EffectsMode::kNone;
  std::vector<EffectGroup> effect_groups;  // with kListed
  EffectChoiceOptions effect_choice;
  std::string calibrate = "all";  // scope.h
  PriorKind prior = PriorKind::kNone;
  TolerancePrior tolerance;
  // With kStored: where an unbounded scope starts from and what holds a partial one (change.h).
  std::optional<StoredCalibration> stored;
};

// How a frame came to be.
enum class FittedOn { kCalibrationRows, kOwnRows };

// How the same model fits the same calibration readings with two sources of joints
// (joint_sources.h).
struct JointComparison {
  int readings = 0;        // calibration readings that have both
  double used_rms_m = 0;   // their RMS position with the joints of the result
  double other_rms_m = 0;  // and with the others
};

struct SetResult {
  std::vector<PoseError> before, after;  // the same readings in the same order
};

struct CalibrationResult {
  Model model;            // candidates of `identification`'s internal part
  Identification before;  // frames alone
  Identification identification;
  // Frames for all placements and targets of the problem, also those seen by control rows only.
  Estimate before_frames, after_frames;
  std::vector<FittedOn> base_fitted_on, tool_fitted_on;
  ParameterSet candidates;  // of identification.set
  int generic_rank = 0;     // what readings of this sort could determine at any poses
  SetResult calibration, control, complete;
  ParameterCounts counts;                  // by the chapter's formulas
  std::vector<SelectionStep> selection;    // with CalibrateOptions::select
  EffectChoice effects;                    // with EffectsMode::kAuto
  std::vector<EffectGroup> effect_groups;  // of the model
  std::vector<Suspect> suspects;           // Suspect::reading indexes the problem's readings
  std::vector<Correlation> correlations;
  // On control rows in frames that the calibration rows have; none when not converged.
  PredictedAccuracy predicted;
  PlaceErrors control_places;             // of contact control rows
  std::optional<JointComparison> joints;  // where the problem has other_q
  std::optional<ChangeTest> change;       // of a partial recalibration from a stored calibration
  std::optional<HeldFit> held_fit;        // beside it
  Verdict verdict;
};

// @returns kInvalidArgument for an empty problem or options that do not fit it; kFailedPrecondition
// with faults when the calibration rows do not
//   determine base and tool, when there are fewer rows than parameters, or with require_complete;
//   kCancelled. A run that does not converge is a result, with its termination in the summary and
//   the verdict do_not_apply.
absl::StatusOr<CalibrationResult> Calibrate(const CalibrationProblem& problem,
                                            const CalibrateOptions& options, const Hooks& hooks);

// How a calibration meets a session that had no part in it: frames fitted on that session's rows,
// lambda nominal (before) and identified (after).
struct EvaluationResult {
  SetResult set;
  Estimate before, after;
};
// @param model that the lambda is of.
absl::StatusOr<EvaluationResult> Evaluate(const CalibrationProblem& problem, const Model& model,
                                          const Eigen::VectorXd& lambda,
                                          const CalibrateOptions& options, const Hooks& hooks);

}  // namespace truepose
