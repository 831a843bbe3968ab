// Numbers of parameters: the chapter's formulas beside the ranks that hold.
//
// For R revolute and P prismatic joints and G measured coordinates of the target
//   complete  4R + 2P + 6   Eq. 11
//   measured  4R + 2P + G   Eq. 12, an upper bound when G < 6 (chapter-notes 10)
//   internal  4R + 2P - 6   Eq. 13, wrong where motions of base and tool overlap (chapter-notes 11)
// The number of internal parameters is N - rank(external), both ranks at generic poses: SCARA 9
// (formula 8), planar 3R 7 (6), PPP 3 (0), single R 0 (-2).
#pragma once

#include "core/identification/identifiability.h"
#include "core/identification/problem.h"
#include "core/robot/robot.h"

namespace truepose {

struct ParameterCounts {
  int complete_by_formula = 0;
  int measured_by_formula = 0;
  int internal_by_formula = 0;
  // At generic poses of the problem's measurement, joint effects left out.
  int rank = 0;
  int external_rank = 0;  // of base, tool and constants of distances alone
  int internal() const { return rank - external_rank; }
};

// @param generic GenericIdentifiable(problem, robot). G is that of the readings with most rows.
ParameterCounts CountParameters(const Robot& robot, const Problem& problem,
                                const IdentifiableSet& generic);

}  // namespace truepose
