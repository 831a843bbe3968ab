// Small tables of a UR10 with errors, made the slow and plain way.
#pragma once

#include <vector>

#include "compensation/lookup.h"
#include "compensation/table.h"

namespace truepose::compensation::testing {

// A UR10 whose identified chain differs from the nominal one by `error` m and rad in every constant
// between joints (not before the first, not behind the last).
Arm Ur10Arm(double error);

// delta of table.h at chain joints, by its definition and poses alone.
Eigen::Matrix<double, 6, 1> DeltaByDefinition(const Arm& arm, const double* q_chain);

// Header, arm and axes of the UR10: q1, q2, q3, q2+q3+q4, q5, q6, of which q1 and q6 are folded and
// the others have so many nodes.
TableContent Ur10Content(const Arm& arm, const std::array<int, 4>& nodes);

// Sets content.nodes by DeltaByDefinition.
void FillNodes(TableContent* content);

// 2 x 3 x 2 x 3 nodes: whole, but too coarse to be of use.
TableContent SmallTable();

// An arm of random links of about 0.4 m, joints of which are prismatic where `prismatic` says so,
// with errors as those of Ur10Arm.
Arm RandomArm(const std::vector<bool>& prismatic, double error, std::uint64_t seed);

// Each joint an axis of its own from -range to range (rad, or m) with 3 nodes and a margin of half
// the range.
TableContent PlainContent(const Arm& arm, double range);

// Where the table's nodes, interpolated, say that the flange stands: by definition, also in the
// margin.
Pose FlangeByTable(const Table& table, const double* q_chain);

// Chain joints at coordinates u of all axes.
std::array<double, kMaxJoints> JointsAt(const TableContent& content, const std::vector<double>& u);

}  // namespace truepose::compensation::testing
