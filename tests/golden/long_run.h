// Tests that draw many seeds draw fewer at every commit.
#pragma once

#include <cstdlib>

namespace truepose::testing {

// The number of draws: `few`, or `many` where TRUEPOSE_LONG is set in the environment. Draws count
// from the same seed, so the few are among the many.
inline int Draws(int few, int many) { return std::getenv("TRUEPOSE_LONG") == nullptr ? few : many; }

}  // namespace truepose::testing
