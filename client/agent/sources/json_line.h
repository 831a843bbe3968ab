// What a line of the JSON interface says.
//
//   {"begin": {"session": {"robot": "robots/ur10", "operator": "Ada"}, "id": "UUID", "key": "...",
//              "for_request": true}}     all of it optional where the source has a robot of its own
//   {"reading": {"joints_measured": [0, -1.57, ...], "position_m": {"x": 1.2, "y": 0, "z": 0.4}}}
//   {"seal": {}}
//
// `session` and `reading` are v1::Session and v1::Reading in the JSON of protobuf with the names of
// the .proto files: rad and m.
#pragma once

#include <string_view>
#include <variant>

#include "absl/status/statusor.h"
#include "client/agent/source.h"

namespace truepose::agent {

struct SealLine {};
using JsonLine = std::variant<SessionStart, v1::Reading, SealLine>;

// @returns kInvalidArgument with one fault of `place` for anything else: no JSON, another key or
// more than one, a field that the message doesn't have, a value of another type.
absl::StatusOr<JsonLine> ParseJsonLine(std::string_view text, std::string_view place);

}  // namespace truepose::agent
