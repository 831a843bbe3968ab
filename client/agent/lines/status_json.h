// The agent's state for programs.
#pragma once

#include <string>

#include "client/agent/lines/agent_status.h"
#include "client/agent/lines/json_fields.h"

namespace truepose::agent {

Json StatusJson(const AgentStatus& status);
Json ProgressJson(const SessionProgress& progress);
Json TaskJson(const MeasuringTask& task);

// Prometheus' text format.
std::string MetricsText(const AgentStatus& status);

}  // namespace truepose::agent
