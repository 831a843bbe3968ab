#include "client/cli/table_fault.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/string_view.h"
#include "absl/strings/strip.h"
#include "core/base/fault.h"

namespace truepose::cli {
namespace {

constexpr char kExpected[] =
    "a table that `truepose table build` wrote or `truepose table download` fetched, as it was";

constexpr char kExpectedOfRobot[] =
    "a table of that robot, or with --robot the file of the robot that the table is of";

// An intact file of another robot is no damaged one.
const char* ExpectedOf(compensation::TableFault fault) {
  using compensation::TableFault;
  const bool other = fault == TableFault::kOtherRobot || fault == TableFault::kOtherNominal;
  return other ? kExpectedOfRobot : kExpected;
}

// The part before `separator`, which goes with it; nothing, and `text` as it was, where it isn't.
absl::string_view TakeUntil(absl::string_view separator, absl::string_view* text) {
  const size_t at = text->find(separator);
  if (at == absl::string_view::npos) return "";
  const absl::string_view before = text->substr(0, at);
  text->remove_prefix(at + separator.size());
  return before;
}

}  // namespace

// A report says "WHERE: found X, expected Y", where WHERE and Y may be missing.
absl::Status TableFaultStatus(const compensation::TableReport& report, const std::string& path,
                              const std::string& place) {
  absl::string_view text = report.message.data();
  absl::ConsumePrefix(&text, absl::StrCat(path, ": "));
  std::string field = absl::StrCat(
      place, ": ", absl::StrReplaceAll(compensation::Name(report.fault), {{"_", " "}}));
  const absl::string_view where = absl::StripSuffix(TakeUntil("found ", &text), ": ");
  if (!where.empty() && where != "file") absl::StrAppend(&field, ": ", where);
  absl::string_view expected = text;
  const absl::string_view found = TakeUntil(", expected ", &expected);
  if (found.empty())
    return FaultStatus(std::move(field), std::string(text), ExpectedOf(report.fault));
  return FaultStatus(std::move(field), std::string(found), std::string(expected));
}

}  // namespace truepose::cli
