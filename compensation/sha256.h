// SHA-256 (FIPS 180-4), here because the runtime links no library for it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace truepose::compensation {

class Sha256 {
 public:
  void Add(std::span<const std::byte> bytes) noexcept;
  // @returns the digest of all that was added; nothing can be added behind it.
  std::array<std::uint8_t, 32> Finish() noexcept;

 private:
  void Compress(const std::byte* block) noexcept;

  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::byte, 64> partial_{};  // the first size_ % 64 bytes wait for more
  std::uint64_t size_ = 0;
};

}  // namespace truepose::compensation
