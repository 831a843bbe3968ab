// Which parameters beside a base set are worth their freedom (chapter, Sec. 11, the program behind
// Tables 7 and 8): the base set is fitted, then again with each candidate added; the best one is
// taken when it is worth it, and so on until none is.
//
// Criteria, all of them of the calibration set, which is `problem`; a control set never chooses:
//   kForward          E* = weighted RMS of the residuals; taken when E* falls by at least 5 %: the
//                     chapter's rule. Its E* is the residual that its fits minimise, so it is the
//                     weighted one here: that of the positions alone, in mm, need not fall when a
//                     parameter is added to a correct fit (position_only has it all the same).
//   kBic              n ln(chi2 / n) + k ln n, chi2 the weighted sum of squares of n rows and k
//                     parameters: the profile likelihood, in which a common scale of all weights is
//                     free (weights found with the base set include what it can't explain). Taken
//                     when it falls.
//   kCrossValidation  weighted RMS of the rows of each fold, predicted by the fit to the others.
//                     Parameters are added while it falls at all; those up to the last one whose
//                     fall exceeds its own uncertainty (least_fall_sd) are taken.
// Parameters come one candidate at a time, so two that help only together may be missed by any of
// these; offer them as a group, or start from a larger base set.
// Every refit starts at the fit of the base set and so has its weights (see Solve): the weighted
// cost never grows along a path. Which other parameters a candidate can't be told from is judged at
// lambda = 0, where redundancies are exact (identifiability.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/hooks.h"
#include "core/identification/solve.h"

namespace truepose {

enum class SelectionCriterion { kForward, kBic, kCrossValidation };

// "forward", "bic", "cross_validation".
const char* Name(SelectionCriterion criterion);

// Parameters that come together: one, or a group such as the first harmonics of every joint. Those
// of a group that depend on the ones before them are left out; nothing left skips the candidate.
struct SelectionCandidate {
  std::string label;
  std::vector<int> parameters;  // candidate indices of the problem
};

struct SelectionOptions {
  SelectionCriterion criterion = SelectionCriterion::kForward;
  double least_improvement = 0.05;  // kForward: share of E*
  bool position_only = false;       // kForward: E* is the RMS position error in m, not weighted
  int folds = 10;                   // kCrossValidation, from here on
  uint64_t seed = 1;                // of the folds
  std::vector<int> units;  // one a reading, equal ones are never separated; empty: none are
  // The fall of the cross-validated sum of squares has to exceed this many of its standard
  // deviations, found from the falls of the single units. 0: any fall will do; of 50 sessions
  // without errors 48 then took one of 18 candidates, at 1.0 still 11, at 1.5 one (BIC: 13).
  double least_fall_sd = 1.5;
  SolveOptions solve;  // of the fits that are kept; always by Levenberg-Marquardt
};

struct SelectionStep {
  std::string added;        // label, "" is the base set
  int parameters = 0;       // with what was added
  double weighted_rms = 0;  // sqrt(2 cost / rows), the prior's among them
  double criterion = 0;     // E*, BIC, or the cross-validated weighted RMS
  bool taken = false;
};

struct SelectionResult {
  std::vector<int> active;          // base and taken ones, ascending
  std::vector<std::string> added;   // labels in the order taken
  Estimate estimate;                // fitted over `active`
  std::vector<SelectionStep> path;  // the base set, and the best of each round to the end
};

// @param start near the minimum over `base`. @param base independent candidates.
// @returns kCancelled; kInvalidArgument when there are fewer units than folds, fewer than 2 folds,
// or units are not one a reading; kFailedPrecondition when the readings outside one fold do not
// determine what all of them do.
absl::StatusOr<SelectionResult> Select(const Problem& problem, const ModelError& model_error,
                                       const Estimate& start, const std::vector<int>& base,
                                       const std::vector<SelectionCandidate>& candidates,
                                       const SelectionOptions& options, const Hooks& hooks);

}  // namespace truepose
