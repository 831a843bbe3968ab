// Blocks of rows that tell most of the parameters together (D-optimality).
//
// Block h is the whitened derivative J_h of one reading by p parameters. Of K blocks N are chosen
// so that
//   log det sum_chosen J_h' J_h
// is large, which makes the volume of the parameters' confidence ellipsoid small: blocks are added
// one at a time, each time that with the largest gain
//   log det(I + J_h M^-1 J_h'),  M = sum of those chosen,
// and then every chosen one is exchanged for the best other one until no exchange gains. That ends
// in an optimum of single exchanges, not in the best of all subsets; equal gains go to the lower
// index, so the answer depends on the blocks alone.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/hooks.h"

namespace truepose {

// log det sum J_h' J_h over the chosen blocks; minus infinity when they do not determine all
// parameters.
double LogDetOf(const std::vector<Eigen::MatrixXd>& blocks, const std::vector<int>& chosen);

// @param blocks of equal columns; all of them together of full column rank. @param count 1 to
// their number. @returns indices in ascending order. Cancelled (hooks), it returns what it has,
// possibly fewer.
std::vector<int> ChooseDOptimal(const std::vector<Eigen::MatrixXd>& blocks, int count,
                                const Hooks& hooks);

}  // namespace truepose
