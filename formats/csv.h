// Tables of text: comma or semicolon, quotes, BOM, CRLF.
//
// The separator is `;` when the first line has one outside quotes, else `,`. With `;` a number may
// have a decimal comma. A cell may be quoted; inside quotes a doubled quote is one quote and line
// ends are text. Blanks around an unquoted cell are dropped. Blank lines and lines whose cells are
// all empty are left out.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/fault.h"

namespace truepose::formats {

struct CsvRow {
  int line = 0;  // of its first character, counted from 1
  std::vector<std::string_view> cells;
};

// Views into the text that was parsed, which has to outlive the table.
struct CsvTable {
  CsvTable() = default;
  CsvTable(CsvTable&&) = default;
  CsvTable& operator=(CsvTable&&) = default;

  CsvRow header;
  std::vector<CsvRow> rows;  // each with as many cells as the header
  bool decimal_comma = false;
  std::deque<std::string> unquoted;  // what cells with doubled quotes view
};

// Reads the table. Adds a fault for text that is not UTF-8, an open quote, text after a quote, a
// row with more or fewer cells than the header, no header; the rows that could be read are in the
// table.
CsvTable ParseCsv(std::string_view text, std::string_view file_name, FaultList& faults);

// `cells` as one line with `,`, quoted where reading it back needs it, with a line end.
std::string CsvLine(const std::vector<std::string>& cells);

}  // namespace truepose::formats
