// Which RPC is open to whom. Roles come later; until then a token may all that isn't kept for
// persons or admins.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "server/auth/caller.h"

namespace truepose::auth {

enum class Access {
  kEverybody,  // without a token
  kToken,      // with any token that holds
  kPerson,     // not with a machine's
  kAdmin,      // with an admin's
};

struct AccessRow {
  std::string_view service;  // "truepose.v1.RobotService"
  std::string_view method;   // "GetRobot"
  Access access;
};

// A row for each RPC of each service of proto/truepose/v1; a test holds it so, and that no two RPCs
// have one name.
std::span<const AccessRow> AccessTable();

// Nothing when there is no row, or more than one: then nobody may. Ask it once an RPC, not once a
// call.
std::optional<Access> AccessTo(std::string_view method);

// @returns kPermissionDenied with a fault of `authorization` that says whose token may.
absl::Status CheckAccess(const std::optional<Access>& access, const Caller& caller);

}  // namespace truepose::auth
