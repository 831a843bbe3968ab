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

// Writes the session under its name, with revision and etag of this commit.
absl::Status UpdateSession(Transaction& transaction, v1::Session& session);

}  // namespace truepose::store
