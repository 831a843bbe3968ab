// Which rows calibrate and which control. Rows count from 0.
//
//   ""                       all rows calibrate, there is no control set
//   even-odd                 even rows calibrate
//   first:N                  rows 0 .. N-1
//   every:K                  rows 0, K, 2K ...
//   spaced:N                 rows trunc(i (n-1) / (N-1)), i = 0 .. N-1; N = 1: row 0
//   random:SEED[:FRACTION]   Fisher-Yates on mt19937_64(SEED): for i = n-1 down to 1 swap i with a
//   uniform j in 0 .. i
//                            (by rejection); the first round(FRACTION n) of the shuffled units
//                            calibrate; FRACTION 0.5
//   column:NAME=VALUE        rows with that value are control, all others calibrate
//
// A group column makes units of rows with equal values (rows with an empty value are units of their
// own): the rule counts units in the order of their first row instead of rows, so equal values are
// never separated. `column:` reads each row itself, and a unit that it would divide is a fault.
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace truepose {

enum class SplitRule { kAll, kEvenOdd, kFirst, kEvery, kSpaced, kRandom, kColumn };

struct Split {
  SplitRule rule = SplitRule::kAll;
  long long count = 0;  // N or K
  unsigned long long seed = 0;
  double fraction = 0.5;
  std::string column, value;
};

// @returns kInvalidArgument with one fault of field `options.split` that lists the forms.
absl::StatusOr<Split> ParseSplit(const std::string& text);

// @param groups empty, or one group value a row.
// @param values for kColumn: the column's value a row; else ignored.
// @returns for each row whether it calibrates. kInvalidArgument when no row calibrates, when N
// exceeds the rows (units),
//   when no row has the value, or when a group would be divided.
absl::StatusOr<std::vector<bool>> ApplySplit(const Split& split, int rows,
                                             const std::vector<std::string>& groups,
                                             const std::vector<std::string>& values);

}  // namespace truepose
