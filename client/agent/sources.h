// The kinds of sources that a configuration may name.
#pragma once

#include <memory>
#include <vector>

#include "absl/status/statusor.h"
#include "client/agent/config/config.h"
#include "client/agent/source.h"

namespace truepose::agent {

// All configured sources, none started.
// @returns kInvalidArgument with every fault of all of them, fields below SourceSettings::place.
absl::StatusOr<std::vector<std::unique_ptr<Source>>> MakeSources(
    const std::vector<SourceSettings>& settings);

}  // namespace truepose::agent
