// Ids that clients make: of sessions, jobs, spools and requests.
#pragma once

#include <string>

namespace truepose::client {

// A random UUID (version 4) in lower case.
std::string RandomUuid();

}  // namespace truepose::client
