#include "client/cli/names.h"

#include <algorithm>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "core/base/fault.h"

namespace truepose::cli {
namespace {

std::string WithCollection(absl::string_view collection, absl::string_view typed) {
  if (typed.empty() || absl::StartsWith(typed, collection)) return std::string(typed);
  return absl::StrCat(collection, typed);
}

bool IsNumber(absl::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), absl::ascii_isdigit);
}

bool IsCalibrationName(absl::string_view name) {
  const std::vector<absl::string_view> parts = absl::StrSplit(name, '/');
  return parts.size() == 4 && parts[0] == "robots" && !parts[1].empty() &&
         parts[2] == "calibrations" && IsNumber(parts[3]);
}

}  // namespace

std::string RobotName(absl::string_view typed) { return WithCollection("robots/", typed); }

std::string SessionName(absl::string_view typed) { return WithCollection("sessions/", typed); }

std::string JobName(absl::string_view typed) { return WithCollection("jobs/", typed); }

std::string TokenName(absl::string_view typed) { return WithCollection("tokens/", typed); }

absl::StatusOr<std::string> CalibrationName(absl::string_view typed) {
  if (IsCalibrationName(typed)) return std::string(typed);
  const std::vector<absl::string_view> parts = absl::StrSplit(typed, '#');
  const std::string name = absl::StrCat(RobotName(parts[0]), "/calibrations/", parts.back());
  if (parts.size() == 2 && IsCalibrationName(name)) return name;
  return FaultStatus("--calibration", absl::StrCat("'", typed, "'"),
                     "a name such as ur10#1 or robots/ur10/calibrations/1");
}

std::string ShortName(absl::string_view name) {
  const std::vector<absl::string_view> parts = absl::StrSplit(name, '/');
  if (IsCalibrationName(name)) return absl::StrCat(parts[1], "#", parts[3]);
  if (parts.size() == 2) return std::string(parts[1]);
  return std::string(name);
}

std::string RobotOf(absl::string_view name) {
  const std::vector<absl::string_view> parts = absl::StrSplit(name, '/');
  if (parts.size() < 2) return std::string(name);
  return absl::StrCat(parts[0], "/", parts[1]);
}

}  // namespace truepose::cli
