// What becomes due by time alone. Called by the server's scheduler again and again; everything is
// decided from what is stored, so a restart neither loses nor repeats anything.
#pragma once

#include "absl/status/statusor.h"
#include "server/store/store.h"

namespace truepose::services {

// Raises a request for each policy whose interval is over (CauseOfInterval). @returns how many. One
// robot's error doesn't keep the others from theirs: it is returned at the end.
absl::StatusOr<int> RaiseDueRequests(store::Store& store);

// Open requests whose expire_time has come become EXPIRED. @returns how many; errors as above.
absl::StatusOr<int> ExpireRequests(store::Store& store);

}  // namespace truepose::services
