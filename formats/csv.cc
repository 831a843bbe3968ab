#include "formats/csv.h"

#include <algorithm>

#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "formats/strings.h"
#include "formats/text_file.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// Of the first line that is not blank.
char SeparatorOf(std::string_view text) {
  bool quoted = false;
  bool blank = true;
  for (const char c : text) {
    blank = blank && (IsBlank(c) || c == '\n');
    if (c == '"') quoted = !quoted;
    if (!quoted && !blank && c == '\n') break;
    if (!quoted && c == ';') return ';';
  }
  return ',';
}

// Takes rows off the front of the text.
class Scanner {
 public:
  Scanner(std::string_view text, std::string_view file, CsvTable& table, FaultList& faults)
      : text_(text), file_(file), separator_(SeparatorOf(text)), table_(table), faults_(faults) {
    table_.decimal_comma = separator_ == ';';
  }

  bool AtEnd() const { return at_ >= text_.size(); }

  CsvRow ReadRow() {
    CsvRow row;
    row.line = line_;
    if (!table_.header.cells.empty()) row.cells.reserve(table_.header.cells.size());
    do {
      row.cells.push_back(ReadCell());
    } while (Take(separator_));
    if (Take('\n')) ++line_;
    return row;
  }

 private:
  bool Take(char c) {
    if (AtEnd() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  void SkipBlanks() {
    while (!AtEnd() && IsBlank(text_[at_])) ++at_;
  }

  std::string_view ReadCell() {
    SkipBlanks();
    return Take('"') ? ReadQuoted() : ReadPlain();
  }

  std::string_view ReadPlain() {
    const size_t begin = at_;
    while (!AtEnd() && text_[at_] != separator_ && text_[at_] != '\n') ++at_;
    size_t end = at_;
    while (end > begin && IsBlank(text_[end - 1])) --end;
    return text_.substr(begin, end - begin);
  }

  std::string_view ReadQuoted() {
    const size_t begin = at_;
    const int first_line = line_;
    bool doubled = false;
    for (; !AtEnd(); ++at_) {
      if (text_[at_] == '\n') ++line_;
      if (text_[at_] != '"') continue;
      if (at_ + 1 >= text_.size() || text_[at_ + 1] != '"') break;
      doubled = true;
      ++at_;
    }
    const std::string_view inside = text_.substr(begin, at_ - begin);
    if (!Take('"')) AddFault(first_line, "a quote that is never closed", "a closing quote");
    ExpectEndOfCell();
    return doubled ? Undouble(inside) : inside;
  }

  void ExpectEndOfCell() {
    const int line = line_;
    const std::string_view rest = ReadPlain();
    if (rest.empty()) return;
    AddFault(line, StrCat(Quoted(rest), " after a closing quote"), "a separator");
  }

  std::string_view Undouble(std::string_view inside) {
    return table_.unquoted.emplace_back(absl::StrReplaceAll(ToAbsl(inside), {{"\"\"", "\""}}));
  }

  void AddFault(int line, std::string found, std::string expected) {
    faults_.Add(StrCat(file_, ":", line), std::move(found), std::move(expected));
  }

  std::string_view text_, file_;
  char separator_;
  CsvTable& table_;
  FaultList& faults_;
  size_t at_ = 0;
  int line_ = 1;
};

bool IsEmptyRow(const CsvRow& row) {
  return std::all_of(row.cells.begin(), row.cells.end(), [](auto cell) { return cell.empty(); });
}

bool HasHeaderWidth(const CsvTable& table, const CsvRow& row, std::string_view file,
                    FaultList& faults) {
  if (row.cells.size() == table.header.cells.size()) return true;
  faults.Add(StrCat(file, ":", row.line), StrCat(row.cells.size(), " cells"),
             StrCat(table.header.cells.size(), " as in the header"));
  return false;
}

bool IsUtf8(std::string_view text, std::string_view file, FaultList& faults) {
  const size_t at = FindNotUtf8(text);
  if (at == std::string_view::npos) return true;
  const auto line = 1 + std::count(text.begin(), text.begin() + at, '\n');
  faults.Add(StrCat(file, ":", line), "bytes of another encoding", "UTF-8 text");
  return false;
}

bool NeedsQuotes(std::string_view cell) {
  if (cell.empty()) return false;
  return cell.find_first_of(",;\"\r\n") != std::string_view::npos || IsBlank(cell.front()) ||
         IsBlank(cell.back()) || cell.starts_with("\xEF\xBB\xBF");
}

}  // namespace

CsvTable ParseCsv(std::string_view text, std::string_view file_name, FaultList& faults) {
  CsvTable table;
  text = WithoutByteOrderMark(text);
  if (!IsUtf8(text, file_name, faults)) return table;
  Scanner scanner(text, file_name, table, faults);
  while (!scanner.AtEnd() && table.header.cells.empty()) {
    CsvRow row = scanner.ReadRow();
    if (!IsEmptyRow(row)) table.header = std::move(row);
  }
  if (table.header.cells.empty()) faults.Add(std::string(file_name), "no text", "a header line");
  while (!scanner.AtEnd() && !IsEnough(faults)) {
    CsvRow row = scanner.ReadRow();
    if (IsEmptyRow(row)) continue;
    if (HasHeaderWidth(table, row, file_name, faults)) table.rows.push_back(std::move(row));
  }
  return table;
}

std::string CsvLine(const std::vector<std::string>& cells) {
  const auto quote = [](std::string* line, const std::string& cell) {
    if (!NeedsQuotes(cell)) return StrAppend(line, cell);
    StrAppend(line, "\"", absl::StrReplaceAll(cell, {{"\"", "\"\""}}), "\"");
  };
  return StrCat(absl::StrJoin(cells, ",", quote), "\n");
}

}  // namespace truepose::formats
