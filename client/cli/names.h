// Short names that people type, and the resource names that the service uses.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "client/uuid.h"

namespace truepose::cli {

// "ur10" or "robots/ur10" -> "robots/ur10"; "" stays "" (all robots).
std::string RobotName(absl::string_view typed);
// A UUID or "sessions/UUID" -> "sessions/UUID".
std::string SessionName(absl::string_view typed);
// A UUID or "jobs/UUID" -> "jobs/UUID".
std::string JobName(absl::string_view typed);
// A UUID or "tokens/UUID" -> "tokens/UUID".
std::string TokenName(absl::string_view typed);
// "ur10#1" or "robots/ur10/calibrations/1" -> the latter. kInvalidArgument with a fault of
// `--calibration` for anything else.
absl::StatusOr<std::string> CalibrationName(absl::string_view typed);

// The other way round, for people: "ur10", the UUID, "ur10#1". A name of another form stays as it
// is.
std::string ShortName(absl::string_view name);

// The robot of "robots/ur10/calibrations/1" or "robots/ur10/nominals/2": "robots/ur10".
std::string RobotOf(absl::string_view name);

using client::RandomUuid;

}  // namespace truepose::cli
