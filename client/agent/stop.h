// A wish to end that threads wait for, with a condition or in poll().
#pragma once

#include <chrono>

namespace truepose::agent {

class Stop {
 public:
  Stop();
  ~Stop();
  Stop(const Stop&) = delete;
  Stop& operator=(const Stop&) = delete;

  // From any thread, any number of times.
  void Request() const;
  bool requested() const;
  // Waits until it is requested or the time is over. @returns requested().
  bool WaitFor(std::chrono::milliseconds time) const;
  // Readable from the request on; for poll() beside other descriptors.
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace truepose::agent
