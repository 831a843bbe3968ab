// Reads a table from the bytes of its file; refuses what is not whole, not intact or not what was
// asked for.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "compensation/lookup.h"
#include "compensation/table_report.h"

namespace truepose::compensation {

// What a table must be for; what is empty is not asked for.
struct TableExpectation {
  std::string_view serial{};  // a table without a serial is refused, too
  std::optional<Digest> nominal_digest{};
  std::optional<Digest> calibration_digest{};
};

// In this order: magic, schema, size, digest of all bytes, every field, expectation.
// @param file  the whole file, at an address divisible by 16; must outlive the table, whose nodes
//   lie in it
// @param table  left alone unless the report is ok
TableReport ReadTable(std::span<const std::byte> file, const TableExpectation& expectation,
                      Table* table) noexcept;

}  // namespace truepose::compensation
