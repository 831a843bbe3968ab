// What becomes due by time alone. Called by the server's scheduler again and again; everything is
// decided from what is stored, so a restart neither loses nor repeats anything. A pass ends early,
// with what it has done, once `is_stopping` says so; the next one does the rest.
#pragma once

#include <functional>

#include "absl/status/statusor.h"
#include "server/store/store.h"

namespace truepose::services {

using IsStopping = std::function<bool()>;

// Raises a request for each policy whose interval is over (CauseOfInterval). @returns how many. One
// robot's error doesn't keep the others from theirs: it is returned at the end.
absl::StatusOr<int> RaiseDueRequests(store::Store& store, const IsStopping& is_stopping);

// Open requests whose expire_time has come become EXPIRED. @returns how many; errors as above.
absl::StatusOr<int> ExpireRequests(store::Store& store, const IsStopping& is_stopping);

}  // namespace truepose::services
