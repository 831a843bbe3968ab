#include "server/store/names.h"

#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "core/base/fault.h"

namespace truepose::store {
namespace {

constexpr size_t kLongestRobotId = 63;
constexpr char kUuidForm[] = "xxxxxxxx-xxxx-xxxx-xxxx-xxxxxxxxxxxx";

bool IsIdCharacter(char c) { return absl::ascii_islower(c) || absl::ascii_isdigit(c) || c == '-'; }

bool IsRobotId(std::string_view id) {
  if (id.empty() || id.size() > kLongestRobotId || id[0] == '-') return false;
  for (const char c : id) {
    if (!IsIdCharacter(c)) return false;
  }
  return true;
}

bool IsUuid(std::string_view id) {
  if (id.size() != sizeof(kUuidForm) - 1) return false;
  for (size_t i = 0; i < id.size(); ++i) {
    const bool hex = absl::ascii_isdigit(id[i]) || (id[i] >= 'a' && id[i] <= 'f');
    if (kUuidForm[i] == '-' ? id[i] != '-' : !hex) return false;
  }
  return true;
}

absl::Status NameFault(std::string_view name, std::string_view form, std::string_view field) {
  return FaultStatus(std::string(field), absl::StrCat("'", std::string(name), "'"),
                     std::string(form));
}

absl::StatusOr<std::string> ParseSimple(std::string_view name, std::string_view collection,
                                        bool (*is_id)(std::string_view), std::string_view form,
                                        std::string_view field) {
  const std::vector<std::string> parts = absl::StrSplit(std::string(name), '/');
  if (parts.size() == 2 && parts[0] == collection && is_id(parts[1])) return parts[1];
  return NameFault(name, form, field);
}

// One name per number: "07" or "+7" would be a second name of "7".
bool IsNumber(const std::string& text, int64_t& number) {
  return absl::SimpleAtoi(text, &number) && number > 0 && absl::StrCat(number) == text;
}

absl::StatusOr<NumberedName> ParseNumbered(std::string_view name, std::string_view collection,
                                           std::string_view form, std::string_view field) {
  const std::vector<std::string> parts = absl::StrSplit(std::string(name), '/');
  int64_t number = 0;
  if (parts.size() == 4 && parts[0] == "robots" && IsRobotId(parts[1]) && parts[2] == collection &&
      IsNumber(parts[3], number)) {
    return NumberedName{parts[1], number};
  }
  return NameFault(name, form, field);
}

}  // namespace

std::string RobotName(std::string_view robot_id) { return "robots/" + std::string(robot_id); }

std::string SessionName(std::string_view session_id) {
  return "sessions/" + std::string(session_id);
}

std::string JobName(std::string_view job_id) { return "jobs/" + std::string(job_id); }

std::string TokenName(std::string_view token_id) { return "tokens/" + std::string(token_id); }

std::string NominalName(std::string_view robot_id, int64_t number) {
  return absl::StrCat(RobotName(robot_id), "/nominals/", number);
}

std::string CalibrationName(std::string_view robot_id, int64_t number) {
  return absl::StrCat(RobotName(robot_id), "/calibrations/", number);
}

std::string CompensationTableName(std::string_view robot_id, std::string_view table_id) {
  return absl::StrCat(RobotName(robot_id), "/compensationTables/", std::string(table_id));
}

absl::StatusOr<std::string> ParseRobotName(std::string_view name, std::string_view field) {
  return ParseSimple(name, "robots", IsRobotId, "robots/{robot}", field);
}

absl::StatusOr<std::string> ParseSessionName(std::string_view name, std::string_view field) {
  return ParseSimple(name, "sessions", IsUuid, "sessions/{uuid}", field);
}

absl::StatusOr<std::string> ParseJobName(std::string_view name, std::string_view field) {
  return ParseSimple(name, "jobs", IsUuid, "jobs/{uuid}", field);
}

absl::StatusOr<std::string> ParseTokenName(std::string_view name, std::string_view field) {
  return ParseSimple(name, "tokens", IsUuid, "tokens/{uuid}", field);
}

absl::StatusOr<NumberedName> ParseNominalName(std::string_view name, std::string_view field) {
  return ParseNumbered(name, "nominals", "robots/{robot}/nominals/{number}", field);
}

absl::StatusOr<NumberedName> ParseCalibrationName(std::string_view name, std::string_view field) {
  return ParseNumbered(name, "calibrations", "robots/{robot}/calibrations/{number}", field);
}

absl::StatusOr<TableName> ParseTableName(std::string_view name, std::string_view field) {
  const std::vector<std::string> parts = absl::StrSplit(std::string(name), '/');
  if (parts.size() == 4 && parts[0] == "robots" && IsRobotId(parts[1]) &&
      parts[2] == "compensationTables" && IsUuid(parts[3])) {
    return TableName{parts[1], parts[3]};
  }
  return NameFault(name, "robots/{robot}/compensationTables/{uuid}", field);
}

absl::Status CheckRobotId(std::string_view robot_id, std::string_view field) {
  if (IsRobotId(robot_id)) return absl::OkStatus();
  return NameFault(robot_id, "1 to 63 of a-z, 0-9 and -, not beginning with -", field);
}

absl::Status CheckUuid(std::string_view id, std::string_view field) {
  if (IsUuid(id)) return absl::OkStatus();
  return NameFault(id, absl::StrCat("a UUID in lower case, ", kUuidForm), field);
}

}  // namespace truepose::store
