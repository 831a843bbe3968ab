// Transactions and savepoints that roll back unless they are ended by hand.
#pragma once

#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/sql/connection.h"

namespace truepose::store::sql {

class Transaction {
 public:
  static absl::StatusOr<Transaction> Begin(Connection& connection, Access access);
  Transaction(Transaction&& other) noexcept
      : connection_(std::exchange(other.connection_, nullptr)) {}
  Transaction& operator=(Transaction&&) = delete;
  // Rolls back what isn't committed. An error of that is dropped: the database does it on its own
  // then.
  ~Transaction();

  // After a failure nothing of the transaction is stored.
  absl::Status Commit();

 private:
  explicit Transaction(Connection& connection) : connection_(&connection) {}

  Connection* connection_;  // nullptr once ended
};

// A part of a transaction that can be undone alone.
class Savepoint {
 public:
  static absl::StatusOr<Savepoint> Begin(Connection& connection);
  Savepoint(Savepoint&& other) noexcept : connection_(std::exchange(other.connection_, nullptr)) {}
  Savepoint& operator=(Savepoint&&) = delete;
  ~Savepoint();

  absl::Status Release();
  // A failure means that the transaction around it can't be trusted any more.
  absl::Status RollBack();

 private:
  explicit Savepoint(Connection& connection) : connection_(&connection) {}

  Connection* connection_;  // nullptr once ended
};

}  // namespace truepose::store::sql
