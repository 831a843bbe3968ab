// Reads a corrected text again and proves that it is the program that it should be.
#pragma once

#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "programs/program.h"

namespace truepose::programs {

// What one target of the program has to be in the new text, in the program's unit.
struct Expected {
  size_t target = 0;           // index into Program::targets
  std::vector<double> joints;  // one for each of its numbers
};

// Reads `after` from scratch and checks that
//   it has the same targets and remarks, at the same lines;
//   numbers of `expected` are there to their printed precision, all others are as they were;
//   every byte that belongs to no number of `expected` is the same.
// @param program what ReadProgram found in `before`.
// @returns kInternal with the line and what is wrong there.
absl::Status ProveCorrected(std::string_view before, const Program& program,
                            const std::vector<Expected>& expected, std::string_view after,
                            Dialect dialect, int joints);

}  // namespace truepose::programs
