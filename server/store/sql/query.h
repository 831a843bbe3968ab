// Statements with their parameters in one line: Query(connection, "SELECT ... WHERE id = $1", id).
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <type_traits>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/status_macros.h"
#include "server/store/sql/connection.h"

namespace truepose::store::sql {

// Bytes, as opposed to text.
struct BlobView {
  std::string_view bytes;
};

template <typename T>
void Bind(Statement& statement, int index, const T& value) {
  if constexpr (std::is_same_v<T, BlobView>) {
    statement.BindBlob(index, value.bytes);
  } else if constexpr (std::is_integral_v<T>) {
    statement.BindInt64(index, value);
  } else if constexpr (std::is_floating_point_v<T>) {
    statement.BindDouble(index, value);
  } else {
    statement.BindText(index, value);
  }
}

// A statement that is ready for its first Step().
template <typename... Values>
absl::StatusOr<std::unique_ptr<Statement>> Query(Connection& connection, std::string_view sql,
                                                 const Values&... values) {
  TRUEPOSE_ASSIGN_OR_RETURN(std::unique_ptr<Statement> statement, connection.Prepare(sql));
  int index = 0;
  (Bind(*statement, ++index, values), ...);
  return statement;
}

// Runs a statement whose rows, if any, don't matter.
template <typename... Values>
absl::Status Run(Connection& connection, std::string_view sql, const Values&... values) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::unique_ptr<Statement> statement,
                            Query(connection, sql, values...));
  return statement->Step().status();
}

// The first column of the first row of a statement that always has one, such as an aggregate or
// RETURNING.
template <typename... Values>
absl::StatusOr<int64_t> QueryInt64(Connection& connection, std::string_view sql,
                                   const Values&... values) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::unique_ptr<Statement> statement,
                            Query(connection, sql, values...));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, statement->Step());
  if (!found) return absl::InternalError("a statement that always has a row had none");
  const int64_t value = statement->Int64(0);
  // A statement that writes has to run to its end.
  TRUEPOSE_RETURN_IF_ERROR(statement->Step().status());
  return value;
}

}  // namespace truepose::store::sql
