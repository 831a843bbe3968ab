#include "formats/row_reader.h"

#include <algorithm>
#include <utility>

#include "formats/number.h"
#include "formats/strings.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

bool IsEmpty(const CsvRow& row, const Column& column) {
  return column.cell < 0 || row.cells[column.cell].empty();
}

}  // namespace

RowReader::RowReader(const CsvTable& table, const Columns& columns, std::string_view file_name,
                     FaultList& faults)
    : table_(table), columns_(columns), file_name_(file_name), faults_(faults) {}

RowReader::Outcome RowReader::ReadNumbers(const CsvRow& row, Quantity quantity,
                                          std::vector<double>& values) const {
  std::vector<std::optional<double>> cells;
  const Outcome outcome = ReadSome(row, quantity, cells);
  if (outcome != Outcome::kThere) return outcome;
  const ColumnGroup& group = *columns_.Find(quantity);
  values.clear();
  for (size_t i = 0; i < cells.size(); ++i) {
    if (cells[i]) values.push_back(*cells[i]);
    if (!cells[i]) AddEmptyCell(row, group, group.columns[i]);
  }
  return values.size() == cells.size() ? Outcome::kThere : Outcome::kFaulty;
}

RowReader::Outcome RowReader::ReadSome(const CsvRow& row, Quantity quantity,
                                       std::vector<std::optional<double>>& values) const {
  const ColumnGroup* group = columns_.Find(quantity);
  if (group == nullptr) return Outcome::kAbsent;
  values.assign(group->columns.size(), std::nullopt);
  bool readable = true, any = false;
  for (size_t i = 0; i < values.size(); ++i) {
    const Column& column = group->columns[i];
    if (IsEmpty(row, column)) continue;
    any = true;
    double value = 0;
    readable = ReadNumber(row, column, value) && readable;
    values[i] = value;
  }
  // Of an incomplete group the header has the fault already.
  if (!readable || !group->complete) return Outcome::kFaulty;
  return any ? Outcome::kThere : Outcome::kAbsent;
}

std::string_view RowReader::ReadText(const CsvRow& row, Quantity quantity) const {
  const ColumnGroup* group = columns_.Find(quantity);
  if (group == nullptr || IsEmpty(row, group->columns[0])) return "";
  return row.cells[group->columns[0].cell];
}

void RowReader::AddFault(const CsvRow& row, std::string_view column, std::string found,
                         std::string expected) const {
  faults_.Add(StrCat(file_name_, ":", row.line, ": ", column), std::move(found),
              std::move(expected));
}

bool RowReader::ReadNumber(const CsvRow& row, const Column& column, double& value) const {
  const std::string_view cell = row.cells[column.cell];
  const auto number = ParseNumber(cell, table_.decimal_comma);
  if (!number.has_value()) {
    AddFault(row, column.name, Quoted(cell), "a number");
    return false;
  }
  value = column.unit == nullptr ? *number : column.unit->to_si(*number);
  return true;
}

void RowReader::AddEmptyCell(const CsvRow& row, const ColumnGroup& group,
                             const Column& empty) const {
  const auto full = std::find_if_not(group.columns.begin(), group.columns.end(),
                                     [&](const Column& column) { return IsEmpty(row, column); });
  AddFault(row, empty.name, "an empty cell", StrCat("a number, as ", full->name, " has one"));
}

}  // namespace truepose::formats
