#include "programs/mark.h"

#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "formats/strings.h"
#include "programs/lines.h"
#include "programs/program.h"

namespace truepose::programs {
namespace {

using Lines = std::vector<std::string_view>;

constexpr std::string_view kWords = "corrected by truepose, calibration ";
constexpr std::string_view kAdvice = ": correct the original, not this file";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

char CommentSign(Dialect dialect) {
  switch (dialect) {
    case Dialect::kUrScript:
      return '#';
    case Dialect::kKrl:
      return ';';
    case Dialect::kRapid:
      return '!';
  }
  return '#';
}

// Without blanks before it and without its end.
std::string_view Trimmed(std::string_view line) {
  formats::ConsumePrefix(&line, kByteOrderMark);
  const size_t begin = line.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return "";
  return line.substr(begin, line.find_last_not_of(" \t\r\n") + 1 - begin);
}

bool BeginsWithWord(std::string_view line, std::string_view word) {
  const std::string_view text = Trimmed(line);
  return absl::StartsWithIgnoreCase({text.data(), text.size()}, {word.data(), word.size()}) &&
         (text.size() == word.size() || text[word.size()] == ' ' || text[word.size()] == '\t');
}

size_t BelowAttributes(const Lines& lines) {
  size_t i = 0;
  while (i < lines.size() && Trimmed(lines[i]).starts_with('&')) ++i;
  return i;
}

// Below `%%% ... %%%` and the MODULE line.
size_t BelowModule(const Lines& lines) {
  for (size_t i = 0; i < lines.size(); ++i)
    if (BeginsWithWord(lines[i], "MODULE")) return i + 1;
  if (lines.empty() || !Trimmed(lines[0]).starts_with("%%%")) return 0;
  for (size_t i = 1; i < lines.size(); ++i)
    if (Trimmed(lines[i]).starts_with("%%%")) return i + 1;
  return 0;
}

// How many lines stay above the mark. A byte order mark stays the first of the file.
size_t LinesAbove(const Lines& lines, Dialect dialect) {
  if (dialect == Dialect::kKrl && BelowAttributes(lines) > 0) return BelowAttributes(lines);
  if (dialect == Dialect::kRapid && BelowModule(lines) > 0) return BelowModule(lines);
  return !lines.empty() && lines[0].starts_with(kByteOrderMark) ? 1 : 0;
}

// Of the first line; LF where there is none.
std::string_view LineEnd(const Lines& lines) {
  if (lines.empty()) return "\n";
  const size_t end = lines[0].find_first_of("\r\n");
  return end == std::string_view::npos ? "\n" : lines[0].substr(end);
}

int Moved(int line, int mark) { return line >= mark ? line + 1 : line; }

bool AreEqual(const JointTarget& before, const JointTarget& after, int mark) {
  if (Moved(before.line, mark) != after.line || before.what != after.what) return false;
  if (before.joints.size() != after.joints.size()) return false;
  for (size_t j = 0; j < before.joints.size(); ++j) {
    const JointNumber &a = before.joints[j], &b = after.joints[j];
    if (a.value != b.value || a.unit != b.unit) return false;
  }
  return true;
}

// Reasons name lines, which move too.
std::string WithoutDigits(std::string text) {
  std::erase_if(text, [](unsigned char c) { return absl::ascii_isdigit(c); });
  return text;
}

bool AreEqual(const Program& before, const Program& after, int mark) {
  if (before.targets.size() != after.targets.size()) return false;
  if (before.passed_through.size() != after.passed_through.size()) return false;
  for (size_t i = 0; i < before.targets.size(); ++i)
    if (!AreEqual(before.targets[i], after.targets[i], mark)) return false;
  for (size_t i = 0; i < before.passed_through.size(); ++i) {
    const Remark &a = before.passed_through[i], &b = after.passed_through[i];
    if (Moved(a.line, mark) != b.line || WithoutDigits(a.reason) != WithoutDigits(b.reason))
      return false;
  }
  return true;
}

}  // namespace

std::optional<Mark> FindMark(std::string_view text, Dialect dialect) {
  const Lines lines = LinesOf(text);
  for (size_t i = 0; i < lines.size(); ++i) {
    std::string_view line = Trimmed(lines[i]);
    if (!line.starts_with(CommentSign(dialect))) continue;
    line = Trimmed(line.substr(1));
    if (!formats::ConsumePrefix(&line, kWords)) continue;
    return Mark{static_cast<int>(i) + 1, std::string(line.substr(0, line.find_first_of(": ")))};
  }
  return std::nullopt;
}

absl::StatusOr<MarkedText> AddMark(std::string_view text, Dialect dialect, int joints,
                                   std::string_view calibration) {
  const Lines lines = LinesOf(text);
  const size_t above = LinesAbove(lines, dialect);
  size_t at = 0;
  for (size_t i = 0; i < above; ++i) at += lines[i].size();
  const bool unended = at > 0 && text[at - 1] != '\n' && text[at - 1] != '\r';
  MarkedText marked{std::string(text.substr(0, at)), static_cast<int>(above) + 1};
  formats::StrAppend(&marked.text, unended ? LineEnd(lines) : "",
                     std::string(1, CommentSign(dialect)), " ", kWords, calibration, kAdvice,
                     LineEnd(lines), text.substr(at));
  const Program before = ReadProgram(text, dialect, joints);
  if (AreEqual(before, ReadProgram(marked.text, dialect, joints), marked.line)) return marked;
  return absl::InternalError("the corrected text, read again with its mark, has other targets");
}

}  // namespace truepose::programs
