// The one function that a calibration job calls; usable without the server.
//
//   readings with roles -> start values -> "before" (base and tool alone, nominal lambda,
//   calibration rows)
//   -> identification on the calibration rows -> control and complete sets, before and after ->
//   verdict
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/assessment/statistics.h"
#include "core/assessment/verdict.h"
#include "core/identification/identify.h"

namespace truepose {

struct CalibrationProblem {
  const Robot* robot = nullptr;   // not owned
  std::vector<Reading> readings;  // all usable rows
  std::vector<bool> calibrates;   // a role for each reading; the others control
  std::vector<std::string> placements, targets;
  std::vector<std::string> offsets;  // unknown constants of distances
  std::optional<Pose> X_FT_nominal;  // of the target, tried first as start value
};

struct CalibrateOptions {
  IdentifyOptions identify;
  // Dependent directions beyond those that no readings could determine are an error.
  bool require_complete = false;
};

// How a frame came to be.
enum class FittedOn { kCalibrationRows, kOwnRows };

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
  SetResult calibration, control, complete;
  Verdict verdict;
};

// @returns kInvalidArgument for an empty problem; kFailedPrecondition with faults when the
// calibration rows do not
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
absl::StatusOr<EvaluationResult> Evaluate(const CalibrationProblem& problem,
                                          const Eigen::VectorXd& lambda,
                                          const CalibrateOptions& options, const Hooks& hooks);

}  // namespace truepose
