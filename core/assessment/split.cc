#include "core/assessment/split.h"

#include <cmath>
#include <map>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "core/base/fault.h"
#include "core/base/random.h"
#include "core/base/status_macros.h"

namespace truepose {
namespace {

constexpr char kForms[] =
    "even-odd, first:N, every:K, spaced:N, random:SEED[:FRACTION] with 0 < FRACTION < 1, or "
    "column:NAME=VALUE";

bool ParseCount(const std::string& text, long long* count) {
  return absl::SimpleAtoi(text, count) && *count > 0;
}

bool ParseRandom(const std::vector<std::string>& parts, Split* split) {
  uint64_t seed = 0;
  if (parts.size() < 2 || parts.size() > 3 || !absl::SimpleAtoi(parts[1], &seed)) return false;
  split->rule = SplitRule::kRandom;
  split->seed = seed;
  if (parts.size() == 2) return true;
  return absl::SimpleAtod(parts[2], &split->fraction) && split->fraction > 0 && split->fraction < 1;
}

bool ParseColumn(const std::string& text, Split* split) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) return false;
  split->rule = SplitRule::kColumn;
  split->column = text.substr(0, equals);
  split->value = text.substr(equals + 1);
  return true;
}

bool ParseCounted(const std::vector<std::string>& parts, Split* split) {
  static const std::map<std::string, SplitRule> rules = {
      {"first", SplitRule::kFirst}, {"every", SplitRule::kEvery}, {"spaced", SplitRule::kSpaced}};
  const auto it = rules.find(parts[0]);
  if (it == rules.end() || parts.size() != 2) return false;
  split->rule = it->second;
  return ParseCount(parts[1], &split->count);
}

bool Parse(const std::string& text, Split* split) {
  if (text.empty()) return true;
  if (text == "even-odd") {
    split->rule = SplitRule::kEvenOdd;
    return true;
  }
  if (text.rfind("column:", 0) == 0) return ParseColumn(text.substr(7), split);
  const std::vector<std::string> parts = absl::StrSplit(text, ':');
  return parts[0] == "random" ? ParseRandom(parts, split) : ParseCounted(parts, split);
}

absl::Status SplitFault(std::string found, std::string expected) {
  return FaultStatus("options.split", std::move(found), std::move(expected));
}

// Unit of each row, units numbered by their first row.
std::vector<int> UnitsOf(int rows, const std::vector<std::string>& groups, int* count) {
  std::vector<int> units(rows);
  std::map<std::string, int> known;
  *count = 0;
  for (int row = 0; row < rows; ++row) {
    if (groups.empty() || groups[row].empty()) {
      units[row] = (*count)++;
      continue;
    }
    const auto [it, added] = known.emplace(groups[row], *count);
    if (added) ++*count;
    units[row] = it->second;
  }
  return units;
}

std::vector<bool> RandomUnits(const Split& split, int units) {
  const std::vector<int> order = Shuffled(units, split.seed);
  std::vector<bool> calibrates(units, false);
  const long count = std::lround(split.fraction * units);
  for (long i = 0; i < count; ++i) calibrates[order[i]] = true;
  return calibrates;
}

std::vector<bool> SpacedUnits(long long count, int units) {
  std::vector<bool> calibrates(units, false);
  for (long long i = 0; i < count; ++i)
    calibrates[count == 1 ? 0 : i * (units - 1) / (count - 1)] = true;
  return calibrates;
}

// Whether each unit calibrates, for the rules that count.
std::vector<bool> CountedUnits(const Split& split, int units) {
  if (split.rule == SplitRule::kRandom) return RandomUnits(split, units);
  if (split.rule == SplitRule::kSpaced) return SpacedUnits(split.count, units);
  std::vector<bool> calibrates(units, true);
  for (int i = 0; i < units; ++i) {
    if (split.rule == SplitRule::kEvenOdd) calibrates[i] = i % 2 == 0;
    if (split.rule == SplitRule::kFirst) calibrates[i] = i < split.count;
    if (split.rule == SplitRule::kEvery) calibrates[i] = i % split.count == 0;
  }
  return calibrates;
}

absl::StatusOr<std::vector<bool>> ByColumn(const Split& split,
                                           const std::vector<std::string>& values,
                                           const std::vector<int>& units, int unit_count) {
  std::vector<bool> rows(values.size());
  std::vector<int> role_of_unit(unit_count, -1);
  bool any = false;
  for (size_t i = 0; i < values.size(); ++i) {
    const bool control = values[i] == split.value;
    any = any || control;
    rows[i] = !control;
    int& role = role_of_unit[units[i]];
    if (role >= 0 && role != static_cast<int>(control)) {
      return SplitFault(absl::StrCat("column:", split.column, "=", split.value,
                                     " that divides the group of row ", i),
                        "groups whose rows are all calibration or all control");
    }
    role = control;
  }
  if (!any) {
    return SplitFault(absl::StrCat("no row with ", split.column, " = '", split.value, "'"),
                      "a value that the column has");
  }
  return rows;
}

absl::Status CheckCounts(const Split& split, int units) {
  const bool counted = split.rule == SplitRule::kFirst || split.rule == SplitRule::kSpaced;
  if (counted && split.count > units) {
    return SplitFault(absl::StrCat(split.count, " of ", units, " rows or groups"),
                      "at most all of them");
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<Split> ParseSplit(const std::string& text) {
  Split split;
  if (!Parse(text, &split)) return SplitFault(absl::StrCat("'", text, "'"), kForms);
  return split;
}

absl::StatusOr<std::vector<bool>> ApplySplit(const Split& split, int rows,
                                             const std::vector<std::string>& groups,
                                             const std::vector<std::string>& values) {
  int unit_count = 0;
  const std::vector<int> units = UnitsOf(rows, groups, &unit_count);
  std::vector<bool> result(rows);
  if (split.rule == SplitRule::kColumn) {
    TRUEPOSE_ASSIGN_OR_RETURN(result, ByColumn(split, values, units, unit_count));
  } else {
    TRUEPOSE_RETURN_IF_ERROR(CheckCounts(split, unit_count));
    const std::vector<bool> calibrates = CountedUnits(split, unit_count);
    for (int row = 0; row < rows; ++row) result[row] = calibrates[units[row]];
  }
  for (bool calibrates : result) {
    if (calibrates) return result;
  }
  return SplitFault("a split in which no row calibrates", "at least one calibration row");
}

}  // namespace truepose
