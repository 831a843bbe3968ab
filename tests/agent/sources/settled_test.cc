#include "client/agent/sources/settled.h"

#include <gtest/gtest.h>

namespace truepose::agent {
namespace {

v1::Reading At(double q, bool measured = true) {
  v1::Reading reading;
  reading.add_joints_measured(q);
  if (measured) reading.mutable_position_m()->set_x(1.0);
  return reading;
}

constexpr SettleOptions kOptions{.still = std::chrono::milliseconds(500), .tolerance = 1e-3};

// Feeds joints at 10 Hz; the indices that were taken.
std::string Taken(const std::vector<v1::Reading>& readings) {
  Settled settled(kOptions);
  std::string taken;
  for (size_t i = 0; i < readings.size(); ++i) {
    if (settled.Add(readings[i], absl::FromUnixMillis(100 * static_cast<int64_t>(i))))
      taken += std::to_string(i) + " ";
  }
  return taken;
}

// Would catch a reading on the way, and two of one standstill.
TEST(SettledTest, OneReadingOfEachStandstill) {
  std::vector<v1::Reading> readings;
  for (int i = 0; i < 5; ++i) readings.push_back(At(0.1 * i));        // moves, 0 to 4
  for (int i = 0; i < 10; ++i) readings.push_back(At(0.5));           // still from 5
  for (int i = 0; i < 3; ++i) readings.push_back(At(0.5 + 0.1 * i));  // 15 is still there
  for (int i = 0; i < 7; ++i) readings.push_back(At(0.9));            // still from 18
  EXPECT_EQ(Taken(readings), "10 23 ");
}

// Would catch a slow creep, each step of which is within the tolerance.
TEST(SettledTest, CreepingIsNoStandstill) {
  std::vector<v1::Reading> readings;
  for (int i = 0; i < 100; ++i) readings.push_back(At(0.0004 * i));
  EXPECT_EQ(Taken(readings), "");
}

TEST(SettledTest, WaitsForAMeasurement) {
  std::vector<v1::Reading> readings(20, At(0.5, false));
  readings[12] = At(0.5);
  EXPECT_EQ(Taken(readings), "12 ");
}

// Would catch a clock that was set back counting as a standstill.
TEST(SettledTest, TimeThatGoesBackBeginsAnew) {
  Settled settled(kOptions);
  EXPECT_FALSE(settled.Add(At(1), absl::FromUnixSeconds(100)));
  EXPECT_FALSE(settled.Add(At(1), absl::FromUnixSeconds(50)));
  EXPECT_TRUE(settled.Add(At(1), absl::FromUnixSeconds(51)));
}

TEST(SettledTest, TimesNeedAnOffset) {
  v1::Reading reading;
  reading.set_time("2026-03-14T09:26:53.25+02:00");
  EXPECT_EQ(TimeOf(reading), absl::FromUnixMillis(1773473213250));
  for (const char* time : {"", "2026-03-14T09:26:53", "yesterday"}) {
    reading.set_time(time);
    EXPECT_EQ(TimeOf(reading), std::nullopt) << time;
  }
}

}  // namespace
}  // namespace truepose::agent
