// Lines from a pipe, a terminal or a socket.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "client/agent/sources/growing_file.h"
#include "client/agent/stop.h"

namespace truepose::agent {

// Memory is bounded by a line and a block.
class LineStream {
 public:
  // @param descriptor stays the caller's.
  LineStream(int descriptor, size_t longest_line)
      : descriptor_(descriptor), longest_line_(longest_line) {}

  // Waits for the next line, the last one without an end included. nullopt at the end, after an
  // error of reading, and when `stop` is requested.
  std::optional<TextLine> Next(const Stop& stop);

  // Whether Next would have to wait.
  bool WouldWait() const;

 private:
  bool Fill(const Stop& stop);
  TextLine TakeLine();

  const int descriptor_;
  const size_t longest_line_;
  std::string block_;  // read and not handed out
  size_t at_ = 0;
  std::string line_;
  bool cut_ = false, ended_ = false;
  int64_t lines_ = 0;
};

}  // namespace truepose::agent
