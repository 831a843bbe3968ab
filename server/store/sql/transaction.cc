#include "server/store/sql/transaction.h"

#include "core/base/status_macros.h"
#include "server/store/sql/query.h"

namespace truepose::store::sql {

absl::StatusOr<Transaction> Transaction::Begin(Connection& connection, Access access) {
  TRUEPOSE_RETURN_IF_ERROR(connection.Begin(access));
  return Transaction(connection);
}

Transaction::~Transaction() {
  if (connection_ != nullptr) Run(*connection_, "ROLLBACK").IgnoreError();
}

absl::Status Transaction::Commit() {
  TRUEPOSE_RETURN_IF_ERROR(Run(*connection_, "COMMIT"));
  connection_ = nullptr;
  return absl::OkStatus();
}

absl::StatusOr<Savepoint> Savepoint::Begin(Connection& connection) {
  TRUEPOSE_RETURN_IF_ERROR(Run(connection, "SAVEPOINT closure"));
  return Savepoint(connection);
}

Savepoint::~Savepoint() {
  if (connection_ != nullptr) RollBack().IgnoreError();
}

absl::Status Savepoint::Release() {
  return Run(*std::exchange(connection_, nullptr), "RELEASE SAVEPOINT closure");
}

absl::Status Savepoint::RollBack() {
  Connection* connection = std::exchange(connection_, nullptr);
  TRUEPOSE_RETURN_IF_ERROR(Run(*connection, "ROLLBACK TO SAVEPOINT closure"));
  return Run(*connection, "RELEASE SAVEPOINT closure");
}

}  // namespace truepose::store::sql
