#include "client/cli/progress.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"

namespace truepose::cli {
namespace {

constexpr int kColumns = 30;
constexpr char kClearLine[] = "\r\x1b[K";

std::string Drawing(double fraction, bool utf8) {
  const int filled = static_cast<int>(std::lround(fraction * kColumns));
  const std::string bar = std::string(filled, '#') + std::string(kColumns - filled, '.');
  return utf8 ? absl::StrReplaceAll(bar, {{"#", "█"}, {".", "░"}}) : bar;
}

}  // namespace

ProgressBar::ProgressBar(const Console& console, std::string label)
    : console_(console), label_(std::move(label)) {}

ProgressBar::~ProgressBar() {
  if (!shown_.empty()) console_.err << kClearLine << std::flush;
}

void ProgressBar::Show(double fraction, absl::string_view note) {
  if (!console_.err_is_terminal) return;
  const double limited = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
  const std::string line = absl::StrFormat("%s %s %3.0f %%  %s", label_,
                                           Drawing(limited, console_.utf8), 100.0 * limited, note);
  if (line == shown_) return;
  shown_ = line;
  console_.err << kClearLine << line << std::flush;
}

}  // namespace truepose::cli
