// A bar that shows how far something is, for people at a terminal.
#pragma once

#include <string>

#include "absl/strings/string_view.h"
#include "client/cli/console.h"

namespace truepose::cli {

// Draws on `err` of a terminal and nowhere else; goes away with the object, so that what follows
// begins on a clean line.
class ProgressBar {
 public:
  ProgressBar(const Console& console, std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // @param fraction 0 to 1, limited to that. @param note what is going on, such as "identification,
  // iteration 3".
  void Show(double fraction, absl::string_view note);

 private:
  const Console& console_;
  std::string label_;
  std::string shown_;
};

}  // namespace truepose::cli
