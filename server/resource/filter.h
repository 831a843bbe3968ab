// Filters of lists: a part of AIP-160. Terms joined by AND, each `field operator value`:
//   state = "SEALED" AND display_name = "*hall 3*" AND create_time >= "2026-11-01T00:00:00Z"
// Fields are paths such as limits.drift_rms_mm; operators = != < <= > >=; texts in double quotes,
// with * for anything (with = and !=); numbers and true, false as they are; enums by their names;
// times in RFC 3339.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "google/protobuf/message.h"

namespace truepose::resource {

using Predicate = std::function<bool(const google::protobuf::Message&)>;

// @param descriptor of the messages that the predicate will be asked about. "" accepts all.
// @returns kInvalidArgument with a fault of `filter` that says where and what was expected.
absl::StatusOr<Predicate> ParseFilter(const std::string& filter,
                                      const google::protobuf::Descriptor* descriptor);

// The text of a term `field = "text"` without wildcards, which all that the filter accepts have;
// for a look-up that needs to read no others.
std::optional<std::string> TextAskedFor(const std::string& filter, const std::string& field);

}  // namespace truepose::resource
