// Comparing a field with the value that stands in a filter.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "google/protobuf/message.h"
#include "server/resource/filter_tokens.h"

namespace truepose::resource {

// < 0, 0 or > 0 as the field of this message is less than, equal to or greater than the value;
// nothing when it is absent (times) or not equal to a pattern.
using Compare = std::function<std::optional<int>(const google::protobuf::Message&)>;

// @returns kInvalidArgument with a fault of `filter` when the value doesn't fit the field, or the
// operator doesn't.
absl::StatusOr<Compare> MakeCompare(const google::protobuf::FieldDescriptor* field,
                                    const FilterToken& value, const std::string& operation);

}  // namespace truepose::resource
