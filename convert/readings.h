// Sessions of messages to a calibration problem.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "convert/run.h"
#include "core/calibrate/calibrate.h"

namespace truepose::convert {

// Which reading of which session a core reading is; Reading::id indexes the list.
struct RowOf {
  int session;
  int row;
};

struct ReadingsProblem {
  CalibrationProblem problem;  // robot not set; calibrates is empty
  std::vector<RowOf> rows;     // of the usable readings
  std::vector<int> position;   // usable reading -> its place among all rows of all sessions
  std::vector<std::string> warnings;
  std::string joints_used;  // "measured", "commanded" or both with counts
};

// Usable are rows with joints (measured, else commanded) and with what `observe` asks for: pose
// needs position and orientation, point a position, point_axis a position and an orientation or
// axis; unspecified takes the most of each row. Placements belong to their session; a target with a
// name is one for all sessions, one without belongs to its session.
// @returns kInvalidArgument with faults `sessions[i].readings[k]...`.
absl::StatusOr<ReadingsProblem> ReadingsFrom(const v1::Nominal& nominal, const Robot& robot,
                                             const std::vector<const v1::SessionInput*>& sessions,
                                             v1::Observe observe);

// The value of a column in each row of all sessions: placement, target, group, time, or an extra
// column. kInvalidArgument with a fault of `field` that lists the columns there are.
absl::StatusOr<std::vector<std::string>> ColumnValues(
    const std::vector<const v1::SessionInput*>& sessions, const std::string& column,
    const std::string& field);

}  // namespace truepose::convert
