// Sessions of messages to a calibration problem.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "convert/run.h"
#include "core/calibrate/calibrate.h"

namespace truepose::convert {

// Which row of which session a core reading is of; Reading::id indexes the list. Several readings
// may be of one row.
struct RowOf {
  int session;
  int row;
};

struct ReadingsProblem {
  CalibrationProblem problem;  // robot not set; calibrates is empty; other_q has what was commanded
                               // beside the measured joints, unless options.joints asks for one
  std::vector<RowOf> rows;     // of the readings
  std::vector<int> position;   // reading -> the place of its row among all rows of all sessions
  std::vector<std::string> warnings;
  std::string joints_used;  // "measured", "commanded" or both with counts
};

// Usable are rows with joints (options.joints: measured, commanded, or measured and else commanded)
// in which options.observe finds something (observations.h); a row becomes one reading or several.
// Placements belong to their session, and so does a distance's unknown anchor, which is a placement
// of its own. A target with a name is one for all sessions, one without belongs to its session; a
// point p1 of target T is the target T/p1. options.fixture and options.feature_column say where the
// tool stood; the fixture's frame is the M of each placement. options.joint_sd goes to every
// reading. Temperatures are above the mean of their session.
// @returns kInvalidArgument with faults `sessions[i].readings[k]...` and `options...`.
absl::StatusOr<ReadingsProblem> ReadingsFrom(const v1::Nominal& nominal, const Robot& robot,
                                             const std::vector<const v1::SessionInput*>& sessions,
                                             const v1::CalibrationOptions& options);
// With `observe` alone.
absl::StatusOr<ReadingsProblem> ReadingsFrom(const v1::Nominal& nominal, const Robot& robot,
                                             const std::vector<const v1::SessionInput*>& sessions,
                                             v1::Observe observe);

// The value of a column in each row of all sessions: placement, target, group, time, feature,
// anchor, beam, or an extra column. kInvalidArgument with a fault of `field` that lists the columns
// there are.
absl::StatusOr<std::vector<std::string>> ColumnValues(
    const std::vector<const v1::SessionInput*>& sessions, const std::string& column,
    const std::string& field);

}  // namespace truepose::convert
