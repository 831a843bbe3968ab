// Which candidate parameters the readings determine, and what the others can't be told from.
//
// The columns of the whitened identification Jacobian are taken in the order of preference
//   base, tool, joint offsets, lengths, angles; proximal first inside each,
// and a column is kept when the part of it that the kept ones don't explain is not null: a greedy
// basis. The kept set is minimal by construction and complete since it spans the same space as all
// candidates (chapter, Sec. 9; a basis by preference replaces the rule of choosing a partner, and
// gives Table 3's sets for the Stanford arm). The Jacobian is that of the *actual* measurement and
// poses: Eqs. 11 and 12 are upper bounds only (chapter-notes 10).
//
// Two thresholds:
//  - dependent: the unexplained part is below 1e-7 of the column (a double precision Jacobian
//  leaves 1e-13 on exact
//    relations, and no useful direction of a real session was seen below 1e-5); columns of norm
//    zero go out first.
//  - undetermined: given the kept ones, the standard deviation 1 / |unexplained part| of the
//  parameter exceeds a bound,
//    by default 20 mm / 2 deg: any nominal geometry is better than that, so the value stays
//    nominal.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/identification/problem.h"
#include "core/identification/weights.h"

namespace truepose {

// dropped = sum coefficient_k * kept_k: the effect of a unit of `dropped` is that of these amounts
// of kept parameters.
struct NullRelation {
  int dropped = -1;
  std::vector<std::pair<int, double>> kept;  // candidate, coefficient in SI units
  bool undetermined = false;  // true: not dependent, but too weak; `kept` is then empty
  bool structural = false;    // true: holds for any poses of this kind of measurement
  bool of_sockets = false;    // true: a base correction of a placement that only sockets tell
};

struct IdentifiableSet {
  std::vector<int> active;  // kept candidates, ascending
  std::vector<NullRelation> redundancies;
  double condition = 0;  // of the kept columns, each scaled to norm 1
};

struct IdentifiabilityOptions {
  double dependent_below = 1e-7;
  double most_length_sd_m = 0.02;
  double most_angle_sd_rad = 0.035;
  bool use_sd_bounds = true;  // the bounds need weights that mean something
};

// @param J whitened, rows x candidates. @param candidates their names and roles.
IdentifiableSet Identifiable(const Eigen::MatrixXd& J, const ParameterSet& candidates,
                             const IdentifiabilityOptions& options);

// The same on generic poses of the problem's robot: joints drawn within +-1.5 rad and +-0.3 m of
// the middle of the limits, for every sort of reading that the problem has, with its placements and
// targets anywhere. What is dropped here is dropped for any readings. Candidates are the problem's.
// @param problem at least one reading.
IdentifiableSet GenericIdentifiable(const Problem& problem, const Robot& robot);

// "dbeta2 acts as 1 dq2 - 612.7 mm/rad db3": for people, terms by size. Relations that involve base
// or tool name the frame instead of its six terms. A base correction that the others of its frame
// make up is a motion of the base that shows nowhere, and is named as that: "base.rx = not
// observable: turn of base about the line of its sockets, along (1, 0, 0)".
std::string RelationText(const NullRelation& relation, const ParameterSet& candidates);
// What was done about it: "dh2 = dh3: dropped dh3" for two parameters that act alike (also base and
// tool by name: "dq1 = a motion of the base frame: dropped dq1"), else RelationText and what was
// dropped.
std::string DroppedText(const NullRelation& relation, const ParameterSet& candidates);
// A sentence that says why the parameter stayed at nominal. Of two that act alike it is DroppedText
// and at which poses that holds.
std::string ReasonText(const NullRelation& relation, const ParameterSet& candidates);

}  // namespace truepose
