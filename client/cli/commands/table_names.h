// Which compensation table of a server a person means.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "client/client.h"
#include "truepose/v1/compensation_table.pb.h"

namespace truepose::cli {

// What --help says of a TABLE to look at, and of one to change.
extern const char kOneTable[];
extern const char kTableToChange[];

// "robots/ur10/compensationTables/UUID" -> "ur10/UUID".
std::string ShortTable(const std::string& name);

// @param typed ROBOT: its active table; ROBOT/UUID or the whole name; or, with or without ROBOT/,
// at
//   least kShortestPrefix digits at the beginning of a table's UUID or SHA-256.
// @returns kNotFound with a fault of `TABLE` that names the tables that there are, or the server's
//   reason; kInvalidArgument when several begin so.
absl::StatusOr<v1::CompensationTable> FindTable(const client::Client& client,
                                                const std::string& typed);

// The same for a table to delete, or with `deleted` to undelete: ROBOT is its only one then, since
// the active one changes by itself.
absl::StatusOr<v1::CompensationTable> FindTableToChange(const client::Client& client,
                                                        const std::string& typed, bool deleted);

inline constexpr size_t kShortestPrefix = 6;

}  // namespace truepose::cli
