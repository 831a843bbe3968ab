// Which calls gRPC itself repeats when a server is unavailable.
#pragma once

#include <string>

namespace truepose::client {

// gRPC's service config as JSON: four attempts within about a second on UNAVAILABLE, for the calls
// that are idempotent by contract, and for no other. CreateNominalRevision is left out: a repeat
// that comes after another client's revision would add a third one. Streams are left out because
// what they carry is resumed above (append_readings.h, wait_for_job.h).
std::string ServiceConfigJson();

}  // namespace truepose::client
