// Sources from a configuration.
//
//   kind = "csv"     path, and optional poll_ms (200), seal_after_s (0 = when another file takes
//   its
//                    place)
//   kind = "folder"  path, and optional poll_ms (1000)
//   kind = "stdin"   JSON lines (json_line.h)
// Of csv and folder: euler (the convention of rx_, ry_, rz_), sliding ("3" or "3, 4": the joints
// that slide). Of all: still_s and still_tolerance (rad or m; 1e-4), with which only readings of
// standstills are taken; purpose (calibration or check), instrument, fixture, operator,
// display_name, placement of the sessions.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/agent/config/config.h"
#include "client/agent/sources/session_feed.h"

namespace truepose::agent {

// The words for `kind`.
std::vector<std::string> SourceKinds();

// @returns kInvalidArgument with every fault of its settings, fields are the keys: a kind that is
// none, a key that it doesn't have, one that it needs, a value that can't be used.
absl::StatusOr<std::unique_ptr<Source>> MakeSource(const SourceSettings& settings,
                                                   const FaultReport& report);

}  // namespace truepose::agent
