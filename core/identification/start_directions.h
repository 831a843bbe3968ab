// What single coordinates and contacts with planes tell of the base.
//
// Each is n . (R_MB x + p_MB) = m with a known normal n in M and a point x in B: a plane fit of the
// points gives R_MB^T n. A coordinate is a plane with the axis as normal.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace truepose {

// n . p_MT = m of one reading.
struct PlaneRow {
  Eigen::Vector3d normal_M;
  double value_m;
  Eigen::Vector3d x_B;  // nominal tool point
};

// A direction that is known in both frames.
struct Direction {
  Eigen::Vector3d M, B;
};

// All readings of a plane at one height leave the sign of its normal open (by nature: a turn of the
// fixture by half a turn about another axis meets the same contacts), so there are several.
// @returns choices, each with one direction per normal, of at most the four normals that were
// measured most; one empty choice when there is no row. Parallel normals count as one.
std::vector<std::vector<Direction>> DirectionChoices(const std::vector<PlaneRow>& rows);

}  // namespace truepose
