// Where the robot of an estimate meets its contacts exactly.
//
// What a fixture leaves free is exact only for points that lie on its features: a turn about the
// line of two sockets moves no point of that line. A nominal robot predicts points that are
// millimetres off it, and there the turn seems to be seen. So which parameters are identifiable is
// judged at joints q' near the read ones with r(q') = 0 for each contact: by Newton's method,
//   q <- q - J_q^+ r(q),
// the least change of joints at each step. Relations of the model hold at any joints, so they stay
// exact, too. The joints move by as much as the robot's errors are large.
#pragma once

#include "core/identification/problem.h"

namespace truepose {

// The problem with the joints of contact readings (points, points with axis) moved to where they
// touch. Distances and planes leave free what they do at any point, and stay; so does a reading
// that the robot does not reach within 0.5 rad or m of its joints: an arm of two joints, a start
// far off.
Problem AtContacts(Problem problem, const Estimate& estimate);

}  // namespace truepose
