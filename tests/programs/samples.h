// Programs of tests, and what was read in them as text that a person can check.
#pragma once

#include <string>
#include <vector>

#include "programs/correct.h"
#include "programs/program.h"

namespace truepose::programs {

// One line a target: "3 movej: 0 -1.57 0 0 0 0"; a number in d2r() has a ' behind it.
std::string Targets(const Program& program);

// One line a remark: "3 a pose: ...".
std::string Remarks(const Program& program);

// Adds 0.001, 0.002, ... rad (or m) to joints 1, 2, ...: every joint of every target changes.
std::vector<CorrectedJoints> Shifted(const std::vector<std::vector<double>>& targets);

// Gives back what it is asked.
std::vector<CorrectedJoints> Unchanged(const std::vector<std::vector<double>>& targets);

// A file of tests/programs/golden.
std::string Golden(const std::string& name);

inline const std::vector<bool> kSixRevolute(6, false);

}  // namespace truepose::programs
