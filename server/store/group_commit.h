// Several closures in one commit, each in a savepoint of its own.
#pragma once

#include <functional>
#include <span>

#include "absl/status/status.h"
#include "server/store/clock.h"
#include "server/store/transaction.h"

namespace truepose::store {

struct Work {
  std::function<absl::Status(Transaction&)> closure;
  absl::Status result;
};

// Runs every closure and sets its result, which holds once this returns: OK means committed.
// A closure that fails is rolled back alone. When the group as a whole fails (its commit or a
// savepoint), nothing of it is stored and each closure runs again in a commit of its own; so does
// one whose status IsRetryable().
void CommitGroup(sql::Connection& connection, const Clock& clock, std::span<Work* const> group);

}  // namespace truepose::store
