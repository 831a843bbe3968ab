// Where a command writes, and what a person looking at it can see.
#pragma once

#include <ostream>
#include <string>

#include "absl/strings/string_view.h"

namespace truepose::cli {

// Results go to `out`, everything else (warnings, progress, errors) to `err`.
struct Console {
  std::ostream& out;
  std::ostream& err;
  bool err_is_terminal = false;  // progress bars are for people only
  bool colour = false;           // of `out`
  bool utf8 = false;             // false: plain ASCII
};

enum class Colour { kGreen, kYellow, kRed, kBold };

// `text` in a colour on a terminal, else as it is.
std::string Paint(const Console& console, Colour colour, absl::string_view text);

// One line on `err`.
void Warn(const Console& console, absl::string_view text);

}  // namespace truepose::cli
