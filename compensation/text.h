// A short text in place: no allocation, copied with memcpy, at a fixed place of a file.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>

namespace truepose::compensation {

inline constexpr std::size_t kMostTextBytes = 184;

// UTF-8 without a zero byte. A longer text, or one with a zero byte, is kept cut and is not
// valid(): a file is never written with it, so that no name is taken for another that begins alike.
class Text {
 public:
  Text() noexcept = default;
  // From anything that is seen as text, such as a std::string.
  template <std::convertible_to<std::string_view> S>
  Text(const S& from) noexcept {  // NOLINT(google-explicit-constructor)
    const std::string_view text = from;
    size_ = std::min({text.size(), text.find('\0'), kMostTextBytes});
    valid_ = size_ == text.size();
    std::copy_n(text.begin(), size_, bytes_.begin());
  }

  bool valid() const noexcept { return valid_; }
  std::string_view view() const noexcept { return {bytes_.data(), size_}; }
  // With a zero byte behind it.
  const char* c_str() const noexcept { return bytes_.data(); }

 private:
  std::array<char, kMostTextBytes + 1> bytes_{};
  std::size_t size_ = 0;
  bool valid_ = true;
};

}  // namespace truepose::compensation
