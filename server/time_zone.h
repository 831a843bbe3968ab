// The plant's time zone, where the options name none.
#pragma once

#include <string>

namespace truepose::server {

// The IANA name that the system is set to: TZ, then the link /etc/localtime, then UTC.
std::string SystemTimeZone();

}  // namespace truepose::server
