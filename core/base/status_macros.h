// Early return on a status that is not OK; the abseil of Debian 12 has none.
#pragma once

#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

#define TRUEPOSE_CONCAT_INNER(a, b) a##b
#define TRUEPOSE_CONCAT(a, b) TRUEPOSE_CONCAT_INNER(a, b)

// TRUEPOSE_RETURN_IF_ERROR(expr): returns from the function with the status of expr when it is not
// OK.
#define TRUEPOSE_RETURN_IF_ERROR(expr)                                                           \
  do {                                                                                           \
    if (absl::Status truepose_status_ = (expr); !truepose_status_.ok()) return truepose_status_; \
  } while (false)

// TRUEPOSE_ASSIGN_OR_RETURN(lhs, expr): lhs = the value of expr, a StatusOr, or returns its status.
#define TRUEPOSE_ASSIGN_OR_RETURN(lhs, expr) \
  TRUEPOSE_ASSIGN_OR_RETURN_IMPL(TRUEPOSE_CONCAT(truepose_statusor_, __LINE__), lhs, expr)
#define TRUEPOSE_ASSIGN_OR_RETURN_IMPL(statusor, lhs, expr) \
  auto statusor = (expr);                                   \
  if (!statusor.ok()) return statusor.status();             \
  lhs = std::move(statusor).value()
