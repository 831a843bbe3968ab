// A program's joint targets, corrected where they stand.
//
// A line that says so is added (mark.h); every byte else outside of corrected numbers stays as it
// was: comments, folds, line ends, speeds, what is not understood. Numbers are written without
// exponent, with at least 8 decimals in rad and m and 6 in degrees and mm, and up to 10 where they
// had more.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "programs/program.h"

namespace truepose::programs {

// One target's answer: the joints to command, or why there are none.
struct CorrectedJoints {
  std::vector<double> joints;  // rad or m
  std::string fault;           // "" = joints are valid
};

// Asked once for all targets of a program, each with as many joints as the robot has (rad or m);
// answers in their order. A status means that nothing can be corrected.
using Correction = std::function<absl::StatusOr<std::vector<CorrectedJoints>>(
    const std::vector<std::vector<double>>&)>;

struct CorrectOptions {
  // Targets that can't be corrected stay and are listed; without it they refuse the whole program.
  bool keep_uncorrected = false;
  // A joint that would change by more can't be corrected: near a singularity a correction of a
  // millimetre turns a wrist by tens of degrees, and the calibration of another robot does worse.
  double largest_change_rad = 0.0872665;  // 5 degrees
  double largest_change_m = 0.02;         // of joints that slide
  // Digest of what corrects, for the mark of a program in which something was corrected; "" = none.
  std::string calibration = {};
};

// One corrected target, numbers in the unit in which the program has them.
struct Change {
  int line = 0;
  std::string what;
  std::vector<double> before, after;
};

struct CorrectedProgram {
  std::string text;
  int mark_line = 0;                   // of the text: the line that is new; 0 = there is none
  std::vector<Change> changes;         // in the order of the text; lines are those of the input
  std::vector<Remark> uncorrected;     // targets that stayed: no answer, wrong number of joints
  std::vector<Remark> passed_through;  // what was not understood or is no joint target
};

// @param file_name for faults, such as "weld.src:12".
// @param prismatic one for each joint of the robot: whether it slides.
// @returns kInvalidArgument with faults of `file_name` for what is no program text (a NUL byte)
// and,
//   without keep_uncorrected, for every target that can't be corrected: beyond 200 the last fault
//   has the remaining lines. The correction's status when that fails. kInternal when the new text,
//   read again, does not give the corrected joints and everything else as it was: then our own
//   reading or writing is wrong, and no text is handed out.
absl::StatusOr<CorrectedProgram> CorrectProgram(std::string_view text, std::string_view file_name,
                                                Dialect dialect, const std::vector<bool>& prismatic,
                                                const Correction& correction,
                                                const CorrectOptions& options);

}  // namespace truepose::programs
