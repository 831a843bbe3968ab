// The words of a filter, with the place of each for messages.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace truepose::resource {

struct FilterToken {
  enum class Kind { kWord, kText, kOperator };
  Kind kind;
  std::string text;  // of kText without the quotes and backslashes
  size_t column;     // from 1
};

// @returns kInvalidArgument with a fault of `filter` for a text that isn't closed or a letter that
// begins nothing.
absl::StatusOr<std::vector<FilterToken>> SplitFilter(const std::string& filter);

// The fault of a filter at a column.
absl::Status FilterFault(size_t column, const std::string& found, const std::string& expected);

}  // namespace truepose::resource
