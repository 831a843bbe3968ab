// Ids that clients make: of sessions, jobs, spools and requests.
#pragma once

#include <string>
#include <string_view>

namespace truepose::client {

// A random UUID (version 4) in lower case.
std::string RandomUuid();

// The UUID (version 8) that goes with `name` for ever: its SHA-256, cut.
std::string NamedUuid(std::string_view name);

}  // namespace truepose::client
