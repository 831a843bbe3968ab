// What a status should be, with everything it says when it is not.
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/fault.h"
#include "gmock/gmock.h"

namespace truepose::testing {

inline absl::Status StatusOf(const absl::Status& status) { return status; }
template <typename T>
absl::Status StatusOf(const absl::StatusOr<T>& result) {
  return result.status();
}

// Of a status or a StatusOr.
MATCHER(IsOk, "is OK") {
  const absl::Status status = StatusOf(arg);
  *result_listener << status.ToString();
  return status.ok();
}

MATCHER_P(HasCode, code, absl::StatusCodeToString(code)) {
  const absl::Status status = StatusOf(arg);
  *result_listener << status.ToString();
  return status.code() == code;
}

inline std::vector<std::string> FieldsOf(const absl::Status& status) {
  std::vector<std::string> fields;
  for (const Fault& fault : FaultsOf(status)) fields.push_back(fault.field);
  return fields;
}

// kInvalidArgument with faults of exactly these fields, in any order.
MATCHER_P(HasFaultsAt, fields, "") {
  const absl::Status status = StatusOf(arg);
  *result_listener << status.ToString();
  return absl::IsInvalidArgument(status) &&
         ::testing::Value(FieldsOf(status), ::testing::UnorderedElementsAreArray(fields));
}

}  // namespace truepose::testing
