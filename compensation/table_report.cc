#include "compensation/table_report.h"

#include <cstdarg>
#include <cstdio>

namespace truepose::compensation {

const char* Name(TableFault fault) noexcept {
  switch (fault) {
    case TableFault::kNone:
      return "ok";
    case TableFault::kNotOpened:
      return "not_opened";
    case TableFault::kNoMemory:
      return "no_memory";
    case TableFault::kNotATable:
      return "not_a_table";
    case TableFault::kNewerSchema:
      return "newer_schema";
    case TableFault::kTruncated:
      return "truncated";
    case TableFault::kTrailingBytes:
      return "trailing_bytes";
    case TableFault::kDamaged:
      return "damaged";
    case TableFault::kInvalidField:
      return "invalid_field";
    case TableFault::kOtherRobot:
      return "other_robot";
    case TableFault::kOtherNominal:
      return "other_nominal_robot";
    case TableFault::kOtherCalibration:
      return "other_calibration";
  }
  return "unknown";
}

TableReport Refused(TableFault fault, const char* format, ...) noexcept {
  TableReport report;
  report.fault = fault;
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(report.message.data(), report.message.size(), format, arguments);
  va_end(arguments);
  return report;
}

}  // namespace truepose::compensation
