// Ctrl-C as a question that a waiting command asks.
#pragma once

namespace truepose::cli {

// While one of these lives, the first SIGINT only sets a flag; the second ends the program as
// always. Not nested.
class InterruptScope {
 public:
  InterruptScope();
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;

  bool interrupted() const;
};

}  // namespace truepose::cli
