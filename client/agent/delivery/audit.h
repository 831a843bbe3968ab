// Whether the server still has what it once had.
#pragma once

#include <chrono>
#include <map>
#include <string>

#include "absl/status/statusor.h"
#include "client/agent/spool/spool.h"
#include "client/client.h"

namespace truepose::agent {

enum class Audited { kKept, kReopened, kRemoved };

// Asks the server for a done session. One that it hasn't sealed (any more) goes back among the
// sessions, to be sent again; one that it has, and that was sealed here longer than `keep` ago,
// goes.
// @returns kUnavailable and others when the server doesn't say; the session stays done then.
absl::StatusOr<Audited> AuditDone(const client::Client& client, Spool& spool,
                                  const DoneSession& done, std::chrono::seconds keep);

// When a session was first seen without a reading, by a clock that nobody sets.
using EmptySince = std::map<std::string, std::chrono::steady_clock::time_point>;

// Takes away open sessions that have been seen without a reading for longer than `keep`: the server
// never heard of them.
void RemoveEmptySessions(Spool& spool, std::chrono::seconds keep, EmptySince& since);

}  // namespace truepose::agent
