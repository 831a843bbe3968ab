#include "client/cli/histogram.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "client/cli/table.h"

namespace truepose::cli {
namespace {

constexpr int kMostBins = 16;
constexpr int kBarColumns = 24;

double Largest(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) {
    if (std::isfinite(value)) largest = std::max(largest, value);
  }
  return largest;
}

int DigitsOf(double width) { return std::max(0, -static_cast<int>(std::floor(std::log10(width)))); }

int LargestCount(const std::vector<int>& counts) {
  return *std::max_element(counts.begin(), counts.end());
}

// Eighths of a cell, the finest that a terminal shows.
std::string Utf8Bar(int eighths) {
  static constexpr const char* kPart[] = {"", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  std::string bar;
  for (int i = 0; i < eighths / 8; ++i) bar += "█";
  return bar + kPart[eighths % 8];
}

}  // namespace

double BinWidth(double largest, int most_bins) {
  if (!std::isfinite(largest) || largest <= 0.0) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(largest / most_bins)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    // A largest value just on the last edge must not need one bin more.
    if (largest / (factor * power) <= most_bins * (1.0 + 1e-12)) return factor * power;
  }
  return 10.0 * power;
}

std::vector<int> CountBins(const std::vector<double>& values, double width, int bins) {
  std::vector<int> counts(bins, 0);
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    // 0.3 belongs to the bin that begins with 3 * 0.1, though the quotient of these doubles is
    // below 3.
    const double bin = std::floor(std::max(0.0, value) / width + 1e-9);
    ++counts[static_cast<int>(std::min(bin, bins - 1.0))];
  }
  return counts;
}

std::string Bar(int count, int largest, int columns, bool utf8) {
  if (count <= 0 || largest <= 0) return "";
  const double share = static_cast<double>(count) / largest;
  if (utf8) return Utf8Bar(std::max(1, static_cast<int>(std::lround(share * columns * 8))));
  return std::string(std::max(1, static_cast<int>(std::lround(share * columns))), '#');
}

std::string BeforeAfterHistogram(const std::vector<double>& before,
                                 const std::vector<double>& after, absl::string_view unit,
                                 bool utf8) {
  if (before.empty() && after.empty()) return "";
  const double largest = std::max(Largest(before), Largest(after));
  const double width = BinWidth(largest, kMostBins);
  const int bins = std::max(1, static_cast<int>(std::ceil(largest / width - 1e-9)));
  const std::vector<int> counts[] = {CountBins(before, width, bins), CountBins(after, width, bins)};
  const int most = std::max(LargestCount(counts[0]), LargestCount(counts[1]));
  Table table({{absl::StrCat("from ", unit)},
               {"before"},
               {"", Align::kLeft},
               {"after"},
               {"", Align::kLeft}});
  for (int i = 0; i < bins; ++i) {
    table.Add({Fixed(i * width, DigitsOf(width)), absl::StrCat(counts[0][i]),
               Bar(counts[0][i], most, kBarColumns, utf8), absl::StrCat(counts[1][i]),
               Bar(counts[1][i], most, kBarColumns, utf8)});
  }
  return table.Text("  ");
}

}  // namespace truepose::cli
