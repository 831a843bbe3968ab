// The bytes of a table, owned: a file mapped into memory, or a copy.
#pragma once

#include <cstddef>
#include <span>

#include "compensation/read_table.h"

namespace truepose::compensation {

// Movable; the table's nodes stay where they are.
class TableFile {
 public:
  TableFile() noexcept = default;
  TableFile(TableFile&& other) noexcept;
  TableFile& operator=(TableFile&& other) noexcept;
  ~TableFile();

  // Maps the file read-only with all its pages, and reads it through once. Replace such a file by
  // renaming another onto its name, which leaves the mapping as it is; bytes that are overwritten
  // in place are no longer those that were checked, and a file cut short ends the process.
  // @param file  left alone unless the report is ok
  static TableReport Map(const char* path, const TableExpectation& expectation,
                         TableFile* file) noexcept;

  // Keeps a copy of the bytes, at any address. Slower to load and safe from writers.
  static TableReport Copy(std::span<const std::byte> bytes, const TableExpectation& expectation,
                          TableFile* file) noexcept;

  // @pre Map or Copy was ok.
  const Table& table() const noexcept { return table_; }

 private:
  TableReport Read(const TableExpectation& expectation) noexcept;

  void* mapping_ = nullptr;
  std::size_t size_ = 0;
  Table table_;
};

}  // namespace truepose::compensation
