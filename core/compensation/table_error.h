// How far a table's correction of one target is off.
//
// The identified flange at the corrected joints is compared with where it should stand: with the
// nominal flange at the target; with fewer than six joints with the identified flange at exactly
// corrected joints, since such an arm can't meet all six coordinates; where the table corrects and
// exact compensation refuses, with the best joints that the latter found, so that it counts. Of a
// measuring arm the corrected flange is compared with the identified one at the same joints.
#pragma once

#include "compensation/arm.h"
#include "compensation/lookup.h"
#include "compensation/outcome.h"
#include "core/compensation/table_domain.h"

namespace truepose {

struct TablePoint {
  compensation::Outcome outcome;  // kOk: `error` is meant
  compensation::PoseError error;
};

// @param arm the truth: the table's own, or that of a calibration it is verified against.
// @param q controller joints.
TablePoint TableErrorAt(const compensation::Table& table, const compensation::Arm& arm,
                        const double* q);

// Coordinates, ranges and margins as they stand in a table.
TableDomain DomainOfTable(const compensation::Table& table);

}  // namespace truepose
