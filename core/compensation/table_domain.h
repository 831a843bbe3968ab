// Where a table holds: the box of coordinates u that its spec asks for.
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "core/base/random.h"
#include "core/compensation/table_axes.h"
#include "core/compensation/table_spec.h"

namespace truepose {

struct TableDomain {
  TableAxes axes;
  std::vector<AxisRange> range;  // of each u
  std::vector<double> margin;    // nodes reach so far beyond each range (compensation/table.h)
  // Of a box: poses drawn uniformly in it, and how many of them the configuration does not reach
  // within its limits.
  int poses = 0;
  int unreachable = 0;
};

// @returns kFailedPrecondition with a fault for a box of which no pose is reached.
absl::StatusOr<TableDomain> DomainOf(const compensation::Arm& arm, const TableSpec& spec);

// The whole range of u_k that the controller joints' limits allow, of a turning joint without
// limits +-2 pi. Of coordinates on which the correction does not depend: they cost nothing.
AxisRange WidestRange(const compensation::Arm& arm, const TableAxes& axes, int k);

// Twice the largest correction of each u that was found at seeded points of the domain farther from
// a singularity than the spec allows; 0 of a measuring arm, which corrects no joints.
std::vector<double> MarginsOf(const compensation::Arm& arm, const TableDomain& domain,
                              const TableSpec& spec);

// u uniformly in the domain.
JointVector DrawIn(const TableDomain& domain, Random* random);

}  // namespace truepose
