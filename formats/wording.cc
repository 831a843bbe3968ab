#include "formats/wording.h"

#include <algorithm>
#include <numeric>

#include "absl/strings/ascii.h"
#include "absl/strings/str_join.h"
#include "formats/strings.h"

namespace truepose::formats {
namespace {

constexpr size_t kLongestQuote = 40;
constexpr size_t kEnoughFaults = 10000;
// A slip is one or two letters; more only in a long word.
size_t FarthestSlip(std::string_view word) { return std::max<size_t>(2, word.size() / 3); }

// Levenshtein's distance, by rows.
size_t Distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0]++;
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t changed = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

bool IsContinuation(char c) { return (c & 0xC0) == 0x80; }

}  // namespace

std::string Quoted(std::string_view text) {
  if (text.size() <= kLongestQuote) return StrCat("'", text, "'");
  size_t end = kLongestQuote;
  while (end > 0 && IsContinuation(text[end])) --end;
  return StrCat("'", text.substr(0, end), "...'");
}

std::string AnyOf(const std::vector<std::string>& choices) {
  if (choices.size() < 2) return absl::StrJoin(choices, "");
  return StrCat(absl::StrJoin(choices.begin(), choices.end() - 1, ", "), " or ", choices.back());
}

std::string Nearest(std::string_view word, const std::vector<std::string>& choices) {
  // The word may be as long as the file; nothing so long is a slip.
  if (word.size() > kLongestQuote) return "";
  const std::string lower = AsciiToLower(word);
  std::string nearest;
  size_t best = FarthestSlip(word) + 1;
  for (const std::string& choice : choices) {
    const size_t distance = Distance(lower, AsciiToLower(choice));
    // A word that shares no letter with the choice is not a slip of it, however short.
    if (distance >= best || distance >= std::max(word.size(), choice.size())) continue;
    best = distance;
    nearest = choice;
  }
  return nearest;
}

bool IsEnough(const FaultList& faults) { return faults.faults().size() >= kEnoughFaults; }

}  // namespace truepose::formats
