#include "client/cli/written_units.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "absl/strings/strip.h"
#include "client/cli/outcome.h"
#include "core/base/fault.h"

namespace truepose::cli {
namespace {

struct Units {
  absl::string_view si, written;
  double factor;
};

constexpr Units kUnits[] = {{"m", "mm", 1e3}, {"rad", "deg", 180.0 / std::numbers::pi}};

// "2e-09 m, or none" -> "2e-06 mm, or none".
std::string Respelled(absl::string_view text, const Units& units) {
  std::vector<std::string> words = absl::StrSplit(text, ' ');
  for (size_t i = 0; i + 1 < words.size(); ++i) {
    absl::string_view unit = words[i + 1], rest = unit;
    double number = 0;
    if (!absl::ConsumePrefix(&rest, units.si) || absl::StrContains(rest, units.si)) continue;
    if (!rest.empty() && absl::ascii_isalnum(static_cast<unsigned char>(rest[0]))) continue;
    if (!absl::SimpleAtod(words[i], &number)) continue;
    words[i] = absl::StrCat(number * units.factor);
    words[i + 1] = absl::StrCat(units.written, rest);
  }
  return absl::StrJoin(words, " ");
}

// Numbers before another word than the unit, or before none.
bool HasOtherNumbers(absl::string_view text, const Units& units) {
  const std::vector<std::string> words = absl::StrSplit(text, ' ');
  double number = 0;
  for (size_t i = 0; i < words.size(); ++i) {
    if (!absl::SimpleAtod(words[i], &number)) continue;
    if (i + 1 == words.size() || !absl::StartsWith(words[i + 1], units.si)) return true;
  }
  return false;
}

bool IsGivenIn(const formats::GivenFields& given, const std::string& field) {
  return std::any_of(given.in_si.begin(), given.in_si.end(),
                     [&](const std::string& one) { return absl::EndsWith(field, one); });
}

Fault AsWritten(const Fault& fault, const formats::GivenFields& given) {
  for (const Units& units : kUnits) {
    if (!absl::EndsWith(fault.field, absl::StrCat("_", units.si))) continue;
    if (IsGivenIn(given, fault.field) || HasOtherNumbers(fault.found, units) ||
        HasOtherNumbers(fault.expected, units))
      return fault;
    const absl::string_view stem = absl::StripSuffix(fault.field, units.si);
    return {absl::StrCat(stem, units.written), Respelled(fault.found, units),
            Respelled(fault.expected, units)};
  }
  return fault;
}

}  // namespace

absl::Status InWrittenUnits(const absl::Status& status, const formats::GivenFields& given) {
  FaultList faults;
  for (const Fault& fault : FaultsOf(status)) faults.Add(AsWritten(fault, given));
  if (faults.empty()) return status;
  return WithFaults(status, faults);
}

}  // namespace truepose::cli
