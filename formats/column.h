// What the header of a table says: which cell of a row holds which quantity, in which unit.
//
// A known quantity without its unit, with another unit or in other letters is a fault, and so is a
// group of which only some columns are there, but for single coordinates: these have a deviation
// where the group of deviations is there, and no orientation beside them. Every other name is an
// extra column.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/fault.h"
#include "formats/csv.h"
#include "formats/known_column.h"
#include "formats/unit.h"

namespace truepose::formats {

struct Column {
  static constexpr int kMissing = -1;

  std::string name;            // as in the file
  int cell = kMissing;         // index in a row
  const Unit* unit = nullptr;  // of a number
  bool readable = true;        // false: it is there under a faulty name, nobody knows its unit
};

struct ColumnGroup {
  std::vector<Column> columns;  // all that the quantity has
  bool complete = false;        // each of them can be read
};

class Columns {
 public:
  // Adds all faults of the header, as `file_name:line: column`.
  Columns(const CsvRow& header, const std::vector<KnownColumn>& known, std::string_view file_name,
          FaultList& faults);

  // nullptr when the table has no column of it, not even a faulty one.
  const ColumnGroup* Find(Quantity quantity) const;

  const std::vector<Column>& extra() const { return extra_; }

 private:
  void Bind(const std::vector<KnownColumn>& known, std::string_view name, int cell);
  void Place(const KnownColumn& known, Column column);
  bool HasFault(const std::vector<KnownColumn>& known, std::string_view name, int cell);
  bool HasNumberBeyond(std::string_view name);
  bool MayBeMissing(const KnownColumn& known) const;
  void CheckComplete(const std::vector<KnownColumn>& known);
  ColumnGroup& GroupOf(const KnownColumn& known);
  void AddFault(std::string_view column, std::string found, std::string expected);

  std::string where_;  // "file:line: "
  FaultList& faults_;
  std::vector<ColumnGroup> groups_;  // by Quantity
  std::vector<Column> extra_;
};

}  // namespace truepose::formats
