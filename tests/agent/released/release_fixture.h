// A server whose robots/arm has two approved calibrations with small tables.
#pragma once

#include <chrono>
#include <string>
#include <thread>

#include "tests/integration/server_fixture.h"

namespace truepose::agent::testing {

class ReleaseFixture : public truepose::testing::ServerFixture {
 protected:
  void SetUp() override;
  // Each change of the active calibration queues its table.
  void Activate(int number) const;
  void RollBack() const;

  // Waits for what other threads do. @returns false after half a minute.
  template <typename Condition>
  static bool WaitUntil(Condition condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }
};

}  // namespace truepose::agent::testing
