// agent.toml to AgentConfig.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "client/agent/config/config.h"

namespace truepose::agent {

// Relative paths in it are taken from its folder.
// @returns kInvalidArgument with every fault of the file, `agent.toml:12: robot[1].joints`: keys
// that
//   are missing, unknown, of another type or out of range. Of a file that is no TOML the first
//   fault only.
absl::StatusOr<AgentConfig> ReadConfigFile(const std::string& path);

// The same of `text`, which stands in `path`.
absl::StatusOr<AgentConfig> ParseConfig(std::string_view text, const std::string& path);

}  // namespace truepose::agent
