// How well a table corrects (table_error.h), by the reader's own way from targets to joints.
//
// Targets are of two kinds: drawn uniformly from the domain until so many were corrected as are
// asked for (at most twenty times as many), of which the percentile is, and places
// of the grid where interpolation is worst: the middles of cells, among them those around the nodes
// with the largest second differences, and points drawn beside these nodes.
#pragma once

#include <cstdint>

#include "absl/status/statusor.h"
#include "compensation/lookup.h"
#include "core/base/hooks.h"

namespace truepose {

struct Verification {
  int points = 0;                         // corrected, of both kinds
  compensation::PoseError worst;          // of both kinds
  compensation::PoseError percentile_95;  // of the drawn targets
  // Of the drawn targets, how many were corrected, and why there is no correction.
  int drawn = 0, corrected = 0, near_singular = 0, beyond_limit = 0, outside_domain = 0;

  // What share of the domain is refused near singularities: drawn targets fill it evenly, whatever
  // the grid.
  double NearSingularShare() const {
    return drawn > 0 ? static_cast<double>(near_singular) / drawn : 0;
  }
};

struct VerifyOptions {
  int points = 10000;  // of the drawn ones, to be corrected
  uint64_t seed = 1;
  double begin = 0, end = 1;  // of the progress that is reported
};

// @param arm the truth: the table's own arm, or that of a calibration.
// @returns kCancelled; kInternal when a target ends in an outcome that no target of the domain can
// end in, such as kInvalidArgument: then the table must not be used.
absl::StatusOr<Verification> VerifyTable(const compensation::Table& table,
                                         const compensation::Arm& arm, const VerifyOptions& options,
                                         const Hooks& hooks);

}  // namespace truepose
