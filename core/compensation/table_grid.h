// How many nodes a table needs, told from how its correction curves.
//
// Between nodes h_k apart multilinear interpolation of delta is off by at most
//   e(u) = | sum_k w_k h_k^2 / 8 d2delta/du_k^2 |,   0 <= w_k <= 1,
// to third order: w_k = 1 in the middle between two nodes, 0 at a node. The worst sum over all
// choices of w_k in {0, 1} is the worst of the cell, since a norm is convex in w. Curvatures are
// looked at at seeded points of the domain; h_k are chosen proportional to 1 / sqrt(M_k), M_k the
// largest curvature in units of the tolerances: equal shares of the error give the smallest product
// of node counts.
#pragma once

#include <array>
#include <vector>

#include "core/base/random.h"
#include "core/compensation/correction_twist.h"
#include "core/compensation/table_domain.h"
#include "core/compensation/table_spec.h"

namespace truepose {

// Position and rotation in units of the spec's tolerances; the larger counts.
struct ToleranceUnits {
  double position_m, rotation_rad;
  // @param motion of the flange.
  double SizeOf(const Twist& motion) const {
    return std::max(motion.head<3>().norm() / position_m, motion.tail<3>().norm() / rotation_rad);
  }
};

// Coordinates on which delta does not depend: probes along u_k move the flange by less than a
// thousandth of the tolerances.
std::vector<bool> FoldedAxes(const compensation::Arm& arm, const TableDomain& domain,
                             const ToleranceUnits& units, uint64_t seed);

// d2delta/du_k^2 as motions of the flange at one point, of every unfolded k.
using Curvature = std::vector<Twist>;

std::vector<Curvature> CurvaturesOf(const compensation::Arm& arm, const TableDomain& domain,
                                    const std::vector<bool>& folded, uint64_t seed);

// The largest position and rotation error over the curvatures' points. @param steps h_k of the
// unfolded coordinates.
compensation::PoseError InterpolationError(const std::vector<Curvature>& curvatures,
                                           const std::vector<double>& steps);

// Node counts, 1 of folded coordinates, whose InterpolationError is at most `share` of the
// tolerances.
std::vector<int> ChooseNodes(const TableDomain& domain, const std::vector<bool>& folded,
                             const std::vector<Curvature>& curvatures, const ToleranceUnits& units,
                             double share);

// Of counts that ChooseNodes found.
compensation::PoseError ErrorOf(const TableDomain& domain, const std::vector<int>& nodes,
                                const std::vector<Curvature>& curvatures);

// Of all nodes; a double, since a count that is refused may be beyond any integer.
double NodeCount(const std::vector<int>& nodes);

}  // namespace truepose
