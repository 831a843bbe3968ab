#include "client/cli/console.h"

#include "absl/strings/str_cat.h"

namespace truepose::cli {
namespace {

absl::string_view Code(Colour colour) {
  switch (colour) {
    case Colour::kGreen:
      return "\x1b[32m";
    case Colour::kYellow:
      return "\x1b[33m";
    case Colour::kRed:
      return "\x1b[31m";
    case Colour::kBold:
      return "\x1b[1m";
  }
  return "";
}

}  // namespace

std::string Paint(const Console& console, Colour colour, absl::string_view text) {
  if (!console.colour) return std::string(text);
  return absl::StrCat(Code(colour), text, "\x1b[0m");
}

void Warn(const Console& console, absl::string_view text) {
  console.err << "warning: " << text << "\n";
}

}  // namespace truepose::cli
