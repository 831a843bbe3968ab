// CRC-32C (Castagnoli): polynomial 0x1EDC6F41, reflected, as iSCSI and ext4 use it.
#pragma once

#include <cstdint>
#include <string_view>

namespace truepose::agent {

// Of `bytes` behind those that gave `before`; Crc32c(b, Crc32c(a)) = Crc32c(a + b).
uint32_t Crc32c(std::string_view bytes, uint32_t before = 0);

}  // namespace truepose::agent
