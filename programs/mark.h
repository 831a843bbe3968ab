// The comment line by which a corrected program says that it is one: correcting it again would move
// its targets by the correction once more.
//
//   # corrected by truepose, calibration 5f0c...: correct the original, not this file
//
// It stands as near to the top as the language has comments: in KRL below the lines with &, in
// RAPID below the MODULE line.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "programs/dialect.h"

namespace truepose::programs {

struct Mark {
  int line = 0;             // counted from 1
  std::string calibration;  // its digest, as it is written there
};

// The first one, wherever it stands; nothing in a program that nobody has corrected.
std::optional<Mark> FindMark(std::string_view text, Dialect dialect);

struct MarkedText {
  std::string text;
  int line = 0;  // of the mark, which is the only line that `text` has more
};

// @param calibration what corrected it: of letters and digits only.
// @param joints of the robot, as in ReadProgram.
// @returns kInternal when the marked text, read again, has not the same targets and remarks, a line
//   further down: no text is handed out.
absl::StatusOr<MarkedText> AddMark(std::string_view text, Dialect dialect, int joints,
                                   std::string_view calibration);

}  // namespace truepose::programs
