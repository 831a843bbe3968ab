// What became of a robot program, for people and for programs.
#pragma once

#include <string>

#include "google/protobuf/struct.pb.h"
#include "programs/correct.h"

namespace truepose::cli {

struct ProgramFiles {
  std::string input, output;
  programs::Dialect dialect;
  std::string before;  // the input's text
  bool diff = false;   // whether to show it
};

// Counts, what was not corrected by reason with its lines, and the diff.
std::string ProgramText(const ProgramFiles& files, const programs::CorrectedProgram& corrected);

// {"output","dialect","corrected":[{"line","what","before","after"}],
//  "uncorrected":[{"line","text","reason"}],"passed_through":[{"line","text","reason"}],"mark_line","diff"};
//  lines are those of the
// input, but for the mark's
google::protobuf::Struct ProgramJson(const ProgramFiles& files,
                                     const programs::CorrectedProgram& corrected);

}  // namespace truepose::cli
