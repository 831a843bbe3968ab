// Reads the identification problems arm5 and arm6 of TRUEPOSE_SHARED/bench: simulated once, noise included.
// A plain reader of its own, so that peers share nothing with core.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace truepose::bench {

struct MeasuredPose {
  std::vector<double> q;              // rad
  std::array<double, 3> p_m;          // of T in M
  std::array<double, 4> wxyz;         // orientation of T in M
};

// Parameters in the order base x y rx ry | theta d a alpha beta of each joint | tool x y z rx ry rz; m, rad.
struct SharedProblem {
  std::vector<double> nominal, truth;
  std::vector<bool> free;
  std::vector<MeasuredPose> poses;

  int joints() const { return static_cast<int>(nominal.size() - 10) / 5; }
};

// @param name "arm6" @param poses 81 or 1000. Ends the program with a message when the files can't be read: a
// benchmark without its problem has nothing to say.
SharedProblem ReadSharedProblem(const std::string& name, int poses);

// $TRUEPOSE_SHARED, or ../shared beside the tree.
std::string SharedFolder();

}  // namespace truepose::bench
