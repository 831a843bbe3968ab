// Tells systemd how the program is, as sd_notify does. Without systemd nothing happens.
#pragma once

#include <chrono>
#include <string_view>

namespace truepose::agent {

// "READY=1", "STOPPING=1", "WATCHDOG=1", "STATUS=..."; sent to the socket that $NOTIFY_SOCKET
// names.
void NotifySystemd(std::string_view state);

// How often WATCHDOG=1 is due: half of $WATCHDOG_USEC; 0 = no watchdog.
std::chrono::milliseconds WatchdogInterval();

}  // namespace truepose::agent
