#include "server/time_zone.h"

#include <stdlib.h>

#include <string>

#include "absl/time/time.h"
#include "gtest/gtest.h"

namespace truepose::server {
namespace {

class TimeZoneTest : public ::testing::Test {
 protected:
  TimeZoneTest() {
    const char* before = getenv("TZ");
    if (before != nullptr) before_ = before;
  }
  ~TimeZoneTest() override {
    unsetenv("TZ");
    if (!before_.empty()) setenv("TZ", before_.c_str(), 1);
  }

  std::string before_;
};

TEST_F(TimeZoneTest, TheVariableNamesIt) {
  for (const char* variable : {"Asia/Tokyo", ":Asia/Tokyo"}) {
    setenv("TZ", variable, 1);
    EXPECT_EQ(SystemTimeZone(), "Asia/Tokyo") << variable;
  }
}

// Would catch a status whose zone no reader can load.
TEST_F(TimeZoneTest, WhatIsNoNameIsNotTold) {
  for (const char* variable : {"", ":", "Nowhere/Land", ":/etc/localtime", "<+03>-3"}) {
    setenv("TZ", variable, 1);
    absl::TimeZone zone;
    EXPECT_TRUE(absl::LoadTimeZone(SystemTimeZone(), &zone)) << variable;
    EXPECT_NE(SystemTimeZone(), variable);
  }
}

}  // namespace
}  // namespace truepose::server
