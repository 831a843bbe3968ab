#include "client/agent/stop.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>

namespace truepose::agent {

Stop::Stop() : descriptor_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

Stop::~Stop() { close(descriptor_); }

// A full counter can't be added to, and is readable as it is.
void Stop::Request() const {
  const uint64_t one = 1;
  if (write(descriptor_, &one, sizeof(one)) < 0) return;
}

bool Stop::requested() const { return WaitFor(std::chrono::milliseconds(0)); }

bool Stop::WaitFor(std::chrono::milliseconds time) const {
  pollfd waited{descriptor_, POLLIN, 0};
  return poll(&waited, 1, static_cast<int>(time.count())) > 0;
}

}  // namespace truepose::agent
