// A histogram of residuals before and after, drawn with characters.
#pragma once

#include <string>
#include <vector>

#include "absl/strings/string_view.h"

namespace truepose::cli {

// A step 1, 2 or 5 times a power of ten with which 0..largest takes at most `most_bins` bins. 1
// when largest is not positive or not finite.
double BinWidth(double largest, int most_bins);

// Values in [k width, (k+1) width), k < bins; the last bin takes everything above it too. Values
// that are not finite are left out.
std::vector<int> CountBins(const std::vector<double>& values, double width, int bins);

// `count` of `largest` as a bar of at most `columns` cells; a count that is not zero is never
// invisible.
std::string Bar(int count, int largest, int columns, bool utf8);

// Two columns of bars side by side, one line a bin, with counts. Empty when there are no values.
// @param unit as the figures are, such as "mm".
std::string BeforeAfterHistogram(const std::vector<double>& before,
                                 const std::vector<double>& after, absl::string_view unit,
                                 bool utf8);

}  // namespace truepose::cli
