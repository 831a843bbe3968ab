// A session's row, for the repositories of sessions and of readings. Only for .cc files of this
// folder.
#pragma once

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/keys.h"
#include "server/store/transaction.h"
#include "truepose/v1/session.pb.h"

namespace truepose::store {

// @param key of a session that exists.
absl::StatusOr<v1::Session> ReadSession(Snapshot& snapshot, Key key);

// As it stands in its row: an open session has no reading_count there, since an append must not
// have to write it. Complete() counts them.
absl::StatusOr<v1::Session> ReadSessionMessage(Snapshot& snapshot, Key key);
absl::Status Complete(Snapshot& snapshot, Key key, v1::Session& session);

// Writes the session under its name, with revision and etag of this commit. Readings that are
// appended change neither.
absl::Status UpdateSession(Transaction& transaction, v1::Session& session);

}  // namespace truepose::store
