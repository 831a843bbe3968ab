// Tables of robots/arm as a server would release them.
#pragma once

#include <array>
#include <string>

#include "client/agent/released/released_entry.h"
#include "compensation/table.h"

namespace truepose::agent::testing {

// A small table by the calibration of this number; each number has other parameters.
struct TestTable {
  explicit TestTable(int calibration, const std::string& robot = "robots/arm");

  compensation::TableContent content;
  std::string bytes;    // of its file
  ReleasedEntry entry;  // made active in the order of the numbers
};

// What they are made of. Digests in hex.
compensation::TableContent ContentOf(int calibration, const std::array<int, 4>& nodes);
compensation::Digest DigestOf(const std::string& hex);
std::string FileOf(const compensation::TableContent& content);

}  // namespace truepose::agent::testing
