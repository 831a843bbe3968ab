// What a line of the JSON interface says, for a source that answers nothing (lines/conversation.h
// answers; docs/agent.md has the lines).
//
//   {"op": "begin", "robot": "ur10", "operator": "Ada", "id": "UUID"}
//   {"op": "reading", "joints_deg": [0, -90, ...], "position_mm": [812.5, -40, 633.1]}
//   {"op": "seal"}
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "absl/status/statusor.h"
#include "client/agent/source.h"

namespace truepose::agent {

struct SealLine {};
using JsonLine = std::variant<SessionStart, v1::Reading, SealLine>;

// @param defaults robot and purpose of a begin that names none.
// @returns kInvalidArgument with every fault of the line, fields below `place`: no JSON object,
// another op, a key that it doesn't have, a value of another kind.
absl::StatusOr<JsonLine> ParseJsonLine(std::string_view text, std::string_view place,
                                       const v1::Session& defaults);

}  // namespace truepose::agent
