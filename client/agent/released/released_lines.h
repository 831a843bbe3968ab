// `correct`, `released` and `read_back` of the TCP interface. docs/agent.md is their documentation.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "client/agent/lines/json_fields.h"
#include "client/agent/released/read_back.h"
#include "client/agent/released/released_store.h"

namespace truepose::agent {

struct ReleasedDesk {
  // Of robots/{robot}; null for one that this agent does not look after.
  std::function<std::shared_ptr<const ReleasedState>(const std::string& robot)> state;
  // A read-back came to this (AgentReport.controller_state).
  std::function<void(const std::string& robot, const std::string& controller_state)> on_read_back;
};

// Each answers one message.
// @returns kInvalidArgument with all faults; kNotFound for the robot; kFailedPrecondition while it
//   has no released set, with why.

// Corrected joints in the unit of the question, by the table or, with `exact`, by the identified
// chain itself. A correction that must not be commanded is {"ok":false,"outcome":...} and no
// joints.
absl::StatusOr<Json> CorrectLine(const ReleasedDesk& desk, const Json& message);
// What runs, what the server says, and the path of the file.
absl::StatusOr<Json> ReleasedLine(const ReleasedDesk& desk, const Json& message);
// Which parameters the controller runs (read_back.h).
absl::StatusOr<Json> ReadBackLine(const ReleasedDesk& desk, const Json& message);

// All of them by their `op`, as a Desk wants them.
std::map<std::string, std::function<absl::StatusOr<Json>(const Json& message)>> ReleasedOperations(
    const ReleasedDesk& desk);

}  // namespace truepose::agent
