// The digest that stands in a table's file.
#pragma once

#include <cstddef>
#include <span>

#include "compensation/table.h"

namespace truepose::compensation {

// SHA-256 of all bytes of the file but the digest's own. @param file  at least 56 bytes
Digest DigestOfTable(std::span<const std::byte> file) noexcept;

}  // namespace truepose::compensation
