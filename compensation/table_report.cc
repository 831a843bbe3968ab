#include "compensation/table_report.h"

#include <cstdarg>
#include <cstdio>

namespace truepose::compensation {

const char* Name(TableFault fault) noexcept {
  switch (fault) {
    case TableFault::kNone:
      return "ok";
    case TableFault::kNotOpened:
      return "not opened";
    case TableFault::kNoMemory:
      return "no memory";
    case TableFault::kNotATable:
      return "not a table";
    case TableFault::kNewerSchema:
      return "newer schema";
    case TableFault::kTruncated:
      return "truncated";
    case TableFault::kTrailingBytes:
      return "trailing bytes";
    case TableFault::kDamaged:
      return "damaged";
    case TableFault::kInvalidField:
      return "invalid field";
    case TableFault::kOtherRobot:
      return "other robot";
    case TableFault::kOtherNominal:
      return "other nominal robot";
    case TableFault::kOtherCalibration:
      return "other calibration";
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
