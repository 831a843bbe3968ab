// Abseil's string functions for std::string_view: Debian's abseil has a string_view of its own and
// converts neither way by itself.
#pragma once

#include <string>
#include <string_view>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"

namespace truepose::formats {

inline absl::string_view ToAbsl(std::string_view text) { return {text.data(), text.size()}; }

template <class T>
const T& ToAbsl(const T& value) {
  return value;
}

// Texts and numbers, one after the other.
template <class... Parts>
std::string StrCat(const Parts&... parts) {
  return absl::StrCat(ToAbsl(parts)...);
}

template <class... Parts>
void StrAppend(std::string* text, const Parts&... parts) {
  absl::StrAppend(text, ToAbsl(parts)...);
}

// Takes `prefix` off the front; false, and nothing done, when it is not there.
inline bool ConsumePrefix(std::string_view* text, std::string_view prefix) {
  if (!text->starts_with(prefix)) return false;
  text->remove_prefix(prefix.size());
  return true;
}

inline bool ConsumeSuffix(std::string_view* text, std::string_view suffix) {
  if (!text->ends_with(suffix)) return false;
  text->remove_suffix(suffix.size());
  return true;
}

inline std::string AsciiToLower(std::string_view text) {
  return absl::AsciiStrToLower(ToAbsl(text));
}

}  // namespace truepose::formats
