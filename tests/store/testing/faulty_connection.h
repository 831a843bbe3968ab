// A connection that fails, or ends the process, at its n-th statement.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "server/store/sql/connection.h"

namespace truepose::store {

// Shared by a test and the connection that it decorates. Each run of a statement counts once, and
// so do BEGIN, COMMIT, ROLLBACK and savepoints.
struct FaultPlan {
  std::atomic<int64_t> statements = 0;  // so far
  std::atomic<int64_t> fault_at = 0;    // 1 = the next one of a new plan; 0 = never
  // What happens instead of the statement; may end the process.
  std::function<absl::Status()> fault = [] { return absl::UnavailableError("injected"); };
  // When not empty, only statements that begin so are counted.
  std::string only;

  // A status that isn't OK when it is this statement's turn to fail.
  absl::Status Count(std::string_view sql);
  bool HasStruck() const { return fault_at > 0 && statements >= fault_at; }
};

sql::Decorator Faulty(std::shared_ptr<FaultPlan> plan);

}  // namespace truepose::store
