// Takes numbers and texts out of the rows of a table, in SI units, and gathers what is wrong with
// them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/fault.h"
#include "formats/column.h"
#include "formats/csv.h"

namespace truepose::formats {

class RowReader {
 public:
  enum class Outcome {
    kAbsent,  // no such columns, or all their cells are empty
    kFaulty,  // faults were added, here or for the header
    kThere,
  };

  // All arguments have to outlive the reader.
  RowReader(const CsvTable& table, const Columns& columns, std::string_view file_name,
            FaultList& faults);

  // The numbers of a group in SI units, in its order. A cell that is no finite number is a fault,
  // and so are empty cells beside full ones. `values` holds them only for kThere.
  Outcome ReadNumbers(const CsvRow& row, Quantity quantity, std::vector<double>& values) const;

  // The same for a group whose cells may be empty one by one; kThere when any is full.
  Outcome ReadSome(const CsvRow& row, Quantity quantity,
                   std::vector<std::optional<double>>& values) const;

  // The text of a quantity with one column; "" when it is absent.
  std::string_view ReadText(const CsvRow& row, Quantity quantity) const;

  // A fault `file:line: column`. `column` may be any words that name the place in the row.
  void AddFault(const CsvRow& row, std::string_view column, std::string found,
                std::string expected) const;

  // A fault for an empty cell beside the first full one of the group.
  void AddEmptyCell(const CsvRow& row, const ColumnGroup& group, const Column& empty) const;

 private:
  bool ReadNumber(const CsvRow& row, const Column& column, double& value) const;

  const CsvTable& table_;
  const Columns& columns_;
  std::string_view file_name_;
  FaultList& faults_;
};

}  // namespace truepose::formats
