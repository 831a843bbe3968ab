// The chapter's calibration of a measuring robot (Sec. 11.3), run again on simulated readings of
// the same design: its raw poses were never published, so the experiment is reproduced and not the
// figures.
//
// For each seed a robot is drawn and two operators read the dime once each. The first one's
// readings are split as in the chapter, 40/41, 60/21 and all 81, where the second one's readings
// are the control; 25, 14, and 14 and automatically selected parameters are found by every
// estimator. All fits start at nominal parameters and so have equal weights: costs of one split
// compare exactly.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/assessment/repeatability.h"
#include "core/assessment/statistics.h"
#include "core/base/hooks.h"
#include "core/identification/selection.h"

namespace truepose {

enum class DimeSet { kComplete, kReduced, kSelected };

// "25", "14", "14 + selected".
const char* Name(DimeSet set);

struct Section11Options {
  std::vector<uint64_t> seeds = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  SelectionOptions selection;     // the chapter's rule by default
  std::function<double()> clock;  // s; the core has none. Without it times are 0
};

// How an estimator is run here.
struct DimeEstimator {
  std::string name;  // "levenberg_marquardt", "kalman, one pass"
  SolveOptions options;
};
const std::vector<DimeEstimator>& DimeEstimators();

struct DimeFit {
  DimeSet set = DimeSet::kComplete;
  std::string estimator;
  int calibration_poses = 0, control_poses = 0;
  // Position errors in m. The complete set is the first operator's 81 readings.
  Statistics calibration, control, complete;
  double cost = 0;                 // half the weighted sum of squares of the calibration set
  double time_s = 0;               // of kSelected without the selection, see SelectionRun
  std::vector<std::string> added;  // of kSelected
  Termination termination = Termination::kFailed;
};

// The selection of one split; once, by Levenberg-Marquardt, so that estimators are compared on one
// set.
struct SelectionRun {
  int calibration_poses = 0;
  SelectionResult result;
  double time_s = 0;
};

// Position errors of parameters that no fit on the split has made.
struct DimeSplit {
  int calibration_poses = 0, control_poses = 0;
  // At nominal parameters, nothing fitted: the chapter's Table 4.
  Statistics nominal_calibration, nominal_control;
  // At nominal parameters with base and tool fitted on the calibration set: what the product calls
  // "before".
  Statistics frames_calibration, frames_control;
  // Of the true parameters: what is left is the noise of the readings.
  Statistics true_calibration, true_control;
};

struct Section11Seed {
  uint64_t seed = 0;
  Statistics nominal;           // of all 81, Table 4's complete set
  PairRepeatability operators;  // two readings a hole, evaluated at nominal parameters
  IsoRepeatability operators_iso;
  std::vector<DimeSplit> splits;
  std::vector<SelectionRun> selections;
  std::vector<DimeFit> fits;
};

struct Section11Result {
  std::vector<Section11Seed> seeds;
};

// @returns kCancelled; kInvalidArgument without seeds; what drawing a robot and selecting return.
absl::StatusOr<Section11Result> Section11(const Section11Options& options, const Hooks& hooks);

}  // namespace truepose
