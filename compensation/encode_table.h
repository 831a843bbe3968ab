// The file of a table (docs/formats.md, byte by byte).
#pragma once

#include <cstddef>
#include <vector>

#include "compensation/table.h"
#include "compensation/table_report.h"

namespace truepose::compensation {

// @returns what is wrong with the content, if anything is.
TableReport Check(const TableContent& content) noexcept;

// @returns the file's bytes; the same content gives the same bytes. Empty unless
// Check(content).ok().
std::vector<std::byte> Encode(const TableContent& content);

}  // namespace truepose::compensation
