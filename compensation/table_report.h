// Why a file is no table that may be used. Fixed size, so that refusing needs no memory.
#pragma once

#include <array>

namespace truepose::compensation {

enum class TableFault {
  kNone,
  kNotOpened,  // no such file, no permission, not a regular file
  kNoMemory,
  kNotATable,    // the first bytes are others'
  kNewerSchema,  // written by a later version than this one reads
  kTruncated,
  kTrailingBytes,
  kDamaged,       // its digest is not that of its bytes
  kInvalidField,  // intact, but no table that could be: the message names the field
  kOtherRobot,
  kOtherNominal,
  kOtherCalibration,
};

struct TableReport {
  TableFault fault = TableFault::kNone;
  std::array<char, 256> message{};  // what was found and what was expected; ends with a zero byte

  bool ok() const noexcept { return fault == TableFault::kNone; }
};

// "ok", "damaged", "newer_schema" and so on.
const char* Name(TableFault fault) noexcept;

// A report with a message in the manner of printf, cut at its end where it is too long.
[[gnu::format(printf, 2, 3)]] TableReport Refused(TableFault fault, const char* format,
                                                  ...) noexcept;

}  // namespace truepose::compensation
