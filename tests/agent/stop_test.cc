#include "client/agent/stop.h"

#include <poll.h>

#include <thread>

#include "client/agent/source.h"
#include "gtest/gtest.h"

namespace truepose::agent {
namespace {

// Would catch a wish that a thread that waits for it does not hear, or that is forgotten once
// heard.
TEST(StopTest, WakesWhoWaitsAndStaysRequested) {
  Stop stop;
  EXPECT_FALSE(stop.requested());
  EXPECT_FALSE(stop.WaitFor(std::chrono::milliseconds(1)));
  std::thread requester([&] { stop.Request(); });
  EXPECT_TRUE(stop.WaitFor(std::chrono::minutes(1)));
  requester.join();
  stop.Request();
  EXPECT_TRUE(stop.requested());
  pollfd readable{stop.descriptor(), POLLIN, 0};
  EXPECT_EQ(poll(&readable, 1, 0), 1);
}

}  // namespace
}  // namespace truepose::agent
