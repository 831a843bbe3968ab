// Visitors of table_layout.h that write fields into memory and read them from it. The memory holds
// kNodesAt bytes, which is what all fields take.
#pragma once

#include <algorithm>
#include <cstring>
#include <span>

#include "compensation/table_layout.h"

namespace truepose::compensation {

class FieldWriter {
 public:
  explicit FieldWriter(std::byte* at) noexcept : at_(at) {}

  void U32(const char*, std::uint32_t value) noexcept { Put(&value, sizeof(value)); }
  void U64(const char*, std::uint64_t value) noexcept { Put(&value, sizeof(value)); }
  void I64(const char*, std::int64_t value) noexcept { Put(&value, sizeof(value)); }
  void F64(const char*, double value) noexcept { Put(&value, sizeof(value)); }
  void Flag(const char* name, bool value) noexcept { U32(name, value ? 1 : 0); }
  template <std::size_t n>
  void Raw(const char*, const std::array<std::uint8_t, n>& bytes) noexcept {
    Put(bytes.data(), n);
  }
  template <std::size_t n>
  void Mask(const char* name, const std::array<bool, n>& flags, int count) noexcept {
    std::uint32_t bits = 0;
    for (int i = 0; i < count; ++i) bits |= flags[i] ? 1u << i : 0;
    U32(name, bits);
  }
  void Name(const char* name, const Text& text) noexcept {
    Put(text.view().data(), text.view().size());
    Skip(name, kNameBytes - text.view().size());
  }
  void Skip(const char*, std::size_t bytes) noexcept {
    std::memset(at_, 0, bytes);
    at_ += bytes;
  }
  const std::byte* at() const noexcept { return at_; }

 private:
  void Put(const void* from, std::size_t bytes) noexcept {
    std::memcpy(at_, from, bytes);
    at_ += bytes;
  }

  std::byte* at_;
};

// Reads whatever stands there; counts are kept small enough to be added to. What is no value of its
// field (a flag of 2, bytes behind a name) is read as one that is, so the fields written again give
// other bytes.
class FieldReader {
 public:
  explicit FieldReader(const std::byte* at) noexcept : at_(at) {}

  void U32(const char*, std::uint32_t& value) noexcept { Take(&value, sizeof(value)); }
  void U32(const char* name, int& value) noexcept {
    std::uint32_t read;
    U32(name, read);
    value = static_cast<int>(std::min(read, std::uint32_t{1} << 30));
  }
  void U64(const char*, std::uint64_t& value) noexcept { Take(&value, sizeof(value)); }
  void I64(const char*, std::int64_t& value) noexcept { Take(&value, sizeof(value)); }
  void F64(const char*, double& value) noexcept { Take(&value, sizeof(value)); }
  void Flag(const char* name, bool& value) noexcept {
    std::uint32_t read;
    U32(name, read);
    value = read != 0;
  }
  template <std::size_t n>
  void Raw(const char*, std::array<std::uint8_t, n>& bytes) noexcept {
    Take(bytes.data(), n);
  }
  template <std::size_t n>
  void Mask(const char* name, std::array<bool, n>& flags, int count) noexcept {
    std::uint32_t bits;
    U32(name, bits);
    for (int i = 0; i < std::min(count, static_cast<int>(n)); ++i) flags[i] = bits >> i & 1;
  }
  void Name(const char*, Text& text) noexcept {
    std::array<char, kNameBytes> bytes;
    Take(bytes.data(), kNameBytes);
    text = Text(std::string_view(bytes.data(), strnlen(bytes.data(), kNameBytes)));
  }
  void Skip(const char*, std::size_t bytes) noexcept { at_ += bytes; }

 private:
  void Take(void* to, std::size_t bytes) noexcept {
    std::memcpy(to, at_, bytes);
    at_ += bytes;
  }

  const std::byte* at_;
};

}  // namespace truepose::compensation
