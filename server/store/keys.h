// How the repositories find a row by the name of its resource. Only for .cc files of this folder.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "server/store/transaction.h"

namespace truepose::store {

// The key of a session or job in other tables.
using Key = int64_t;

// @returns kInvalidArgument for the form, kNotFound; both with a fault of `field`.
absl::StatusOr<Key> SessionKey(Snapshot& snapshot, std::string_view name,
                               std::string_view field = "name");
absl::StatusOr<Key> JobKey(Snapshot& snapshot, std::string_view name,
                           std::string_view field = "name");

// The id of a robot that exists; "" stays "" (a list of all robots).
absl::StatusOr<std::string> RobotFilter(Snapshot& snapshot, std::string_view robot);

// Moves the field of a status' fault from "name" to `field`.
absl::Status AtField(const absl::Status& status, std::string_view field);

}  // namespace truepose::store
