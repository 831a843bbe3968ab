// A handler's last line of defence.
#pragma once

#include <exception>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"

namespace truepose::rpc {

// Runs `handle`, which returns absl::StatusOr<T> or absl::Status. Our code throws nothing, but
// memory can run out and libraries can throw: that ends the call, not the server.
template <typename Handle>
auto Guarded(const Handle& handle) -> decltype(handle()) {
  try {
    return handle();
  } catch (const std::exception& e) {
    return absl::InternalError(absl::StrCat("the server failed in this call: ", e.what()));
  }
}

inline absl::Status TooBusy() {
  return absl::UnavailableError("the server has too many calls waiting; try again");
}

}  // namespace truepose::rpc
