// Names of resources as the store keys them.
//   robots/{robot}  robots/{robot}/nominals/{number}  robots/{robot}/calibrations/{number}
//   robots/{robot}/compensationTables/{id}  sessions/{id}  jobs/{id}  tokens/{id}
// Parsing checks the form only; @returns kInvalidArgument with a fault whose field is `field`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace truepose::store {

struct NumberedName {
  std::string robot_id;
  int64_t number = 0;  // from 1

  bool operator==(const NumberedName&) const = default;
};

struct TableName {
  std::string robot_id;
  std::string id;  // a UUID

  bool operator==(const TableName&) const = default;
};

std::string RobotName(std::string_view robot_id);
std::string SessionName(std::string_view session_id);
std::string JobName(std::string_view job_id);
std::string TokenName(std::string_view token_id);
std::string NominalName(std::string_view robot_id, int64_t number);
std::string CalibrationName(std::string_view robot_id, int64_t number);
std::string CompensationTableName(std::string_view robot_id, std::string_view table_id);

absl::StatusOr<std::string> ParseRobotName(std::string_view name, std::string_view field = "name");
absl::StatusOr<std::string> ParseSessionName(std::string_view name,
                                             std::string_view field = "name");
absl::StatusOr<std::string> ParseJobName(std::string_view name, std::string_view field = "name");
absl::StatusOr<std::string> ParseTokenName(std::string_view name, std::string_view field = "name");
absl::StatusOr<NumberedName> ParseNominalName(std::string_view name,
                                              std::string_view field = "name");
absl::StatusOr<NumberedName> ParseCalibrationName(std::string_view name,
                                                  std::string_view field = "name");
absl::StatusOr<TableName> ParseTableName(std::string_view name, std::string_view field = "name");

// Faults of identifiers that a client chooses: robots [a-z0-9][a-z0-9-]{0,62}; sessions and jobs a
// lower-case UUID. Tokens have one too.
absl::Status CheckRobotId(std::string_view robot_id, std::string_view field);
absl::Status CheckUuid(std::string_view id, std::string_view field);

}  // namespace truepose::store
