// Which calls gRPC itself repeats when a server is unavailable.
#pragma once

#include <string>

namespace truepose::client {

// gRPC's service config as JSON: four attempts within about a second on UNAVAILABLE, for every
// unary call: what changes something carries a request id (client.h), so its repeat has no second
// effect. Streams are left out because what they carry is resumed above (append_readings.h,
// download.h, wait_for_job.h, watch.h).
std::string ServiceConfigJson();

}  // namespace truepose::client
