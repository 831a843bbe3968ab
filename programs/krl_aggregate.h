// Aggregates of KRL: {A1 0,A2 -90} and {E6POS: X 1,Y 2}.
#pragma once

#include <string>
#include <vector>

#include "programs/words.h"

namespace truepose::programs {

struct KrlAggregate {
  enum class Kind {
    kAxes,     // plain numbers for A1 ... An
    kPartly,   // some of A1 ... but not without a gap from A1
    kUnclear,  // axes with something else than numbers, or one twice, or no end on its line
    kPose,     // X, Y, Z, A, B or C
    kOther,    // anything else, such as speeds
  };
  Kind kind = Kind::kOther;
  std::vector<JointNumber> axes;  // of kAxes, in their order
  size_t end = 0;                 // the place behind it, or its line's end
};

// @param i place of its {.
KrlAggregate ReadKrlAggregate(const Words& words, size_t i);

}  // namespace truepose::programs
