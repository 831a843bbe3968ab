// Brings one session to the server as far as it stands here.
#pragma once

#include <functional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/agent/spool/session_file.h"
#include "client/client.h"

namespace truepose::agent {

// The UUID of sessions/{uuid}; also the source of its readings.
std::string IdOf(const std::string& session);

// Sends what the server lacks of the readings, creating the session where it isn't, and seals it
// there when it is sealed here. session.delivered is what the server says; `on_delivered` is told
// after each acknowledgement.
// @returns true when the session is sealed on the server, false when it is not sealed here or got
//   readings meanwhile. kUnavailable when the server stays away; kUnauthenticated and
//   kPermissionDenied when it won't have this agent; else what it has against the session. What was
//   acknowledged stays stored, and a repeat goes on from there.
absl::StatusOr<bool> DeliverSession(const client::Client& client, SessionFile& session,
                                    const std::function<void()>& on_delivered = {});

}  // namespace truepose::agent
