// Which parameters beside a base set are worth their freedom (chapter, Sec. 11, the program behind
// Tables 7 and 8): the base set is fitted, then again with each candidate added; the best one is
// taken when it is worth it, and so on until none is.
//
// Criteria, all of them of the calibration set, which is `problem`; a control set never chooses:
//   kForward          E* = RMS position error; taken when E* falls by at least 5 %: the chapter's
//                     rule. Weighs neither the size of the set nor the number of parameters.
//   kBic              n ln(chi2 / n) + k ln n, chi2 the weighted sum of squares of n rows and k
//                     parameters: the profile likelihood, in which a common scale of all weights is
//                     free (weights found with the base set include what it can't explain). Taken
//                     when it falls.
//   kCrossValidation  weighted RMS of the rows of each fold, predicted by the fit to the others.
//                     Taken when it falls by more than its own uncertainty, see least_fall_sd.
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
  double criterion = 0;     // E* in m, BIC, or the cross-validated weighted RMS
  bool taken = false;
};

struct SelectionResult {
  std::vector<int> active;          // base and taken ones, ascending
  std::vector<std::string> added;   // labels in the order taken
  Estimate estimate;                // fitted over `active`
  std::vector<SelectionStep> path;  // the base set, each one taken, and the best that was refused
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
