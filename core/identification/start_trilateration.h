// A point found from its distances to known points.
//
//   |x_k - a|^2 = (d_k - c)^2  <=>  |x_k|^2 - d_k^2 = 2 x_k . a - 2 c d_k - (|a|^2 - c^2)
// is linear in a, c and s = |a|^2 - c^2; each beam (group of distances with an unknown constant in
// common) has c and s of its own, distances without one share an s.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace truepose {

struct Distances {
  std::vector<Eigen::Vector3d> x;  // m, known points
  std::vector<double> d;           // m
  std::vector<int> beam;           // which unknown constant; -1 none
};

// How many distances make the linear system square.
int UnknownsOf(const Distances& distances);

// Guesses of a: the linear solution (of least norm about the mean of x where there are too few),
// and, for x that lie nearly in a plane, both points above and below it that are as far as s says;
// linear alone could not tell mirror images apart and would be all noise in that direction.
// @param distances at least one. @returns three points.
std::vector<Eigen::Vector3d> Trilaterate(const Distances& distances);

}  // namespace truepose
