#include "client/agent/spool/crc32c.h"

#include <array>

namespace truepose::agent {
namespace {

constexpr uint32_t kReflectedPolynomial = 0x82F63B78u;

constexpr uint32_t EntryOf(uint32_t byte) {
  for (int bit = 0; bit < 8; ++bit) byte = (byte >> 1) ^ ((byte & 1u) * kReflectedPolynomial);
  return byte;
}

constexpr std::array<uint32_t, 256> MakeTable() {
  std::array<uint32_t, 256> table{};
  for (uint32_t byte = 0; byte < 256; ++byte) table[byte] = EntryOf(byte);
  return table;
}

constexpr std::array<uint32_t, 256> kTable = MakeTable();

}  // namespace

uint32_t Crc32c(std::string_view bytes, uint32_t before) {
  uint32_t crc = ~before;
  for (const char c : bytes) crc = (crc >> 8) ^ kTable[(crc ^ static_cast<uint8_t>(c)) & 0xFFu];
  return ~crc;
}

}  // namespace truepose::agent
