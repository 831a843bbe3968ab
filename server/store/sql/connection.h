// The narrow seam to a database: everything the repositories need and nothing more.
//
// SQL that goes through it is portable: parameters are $1, $2, ...; types are 64-bit integer,
// double, text and blob. Errors: kAlreadyExists for a key that is taken, kFailedPrecondition for
// another constraint, kResourceExhausted for a full disk, kUnavailable for a disk that fails,
// kDataLoss for a damaged file, kAborted with IsRetryable() when the whole transaction may be run
// again, kInternal otherwise. A connection is used by one thread at a time; a statement must not
// outlive its connection.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace truepose::store::sql {

class Statement {
 public:
  virtual ~Statement() = default;

  // Parameters count from 1. A bad index is reported by the next Step().
  virtual void BindInt64(int index, int64_t value) = 0;
  virtual void BindDouble(int index, double value) = 0;
  virtual void BindText(int index, std::string_view value) = 0;
  virtual void BindBlob(int index, std::string_view value) = 0;

  // Runs up to the next row. @returns whether there is one.
  virtual absl::StatusOr<bool> Step() = 0;
  // Makes the statement ready to run again; parameters stay bound.
  virtual void Reset() = 0;

  // Columns of the current row count from 0; NULL reads as 0 or "".
  virtual int64_t Int64(int column) const = 0;
  virtual double Double(int column) const = 0;
  virtual std::string Text(int column) const = 0;
  virtual std::string Blob(int column) const = 0;
};

enum class Access { kRead, kWrite };

class Connection {
 public:
  virtual ~Connection() = default;

  virtual absl::StatusOr<std::unique_ptr<Statement>> Prepare(std::string_view sql) = 0;
  // Runs one or more statements that have neither parameters nor rows.
  virtual absl::Status Execute(std::string_view sql) = 0;
  // Opens a transaction; prefer sql::Transaction. kWrite takes the write lock at once, so that it
  // can't be lost later.
  virtual absl::Status Begin(Access access) = 0;

  // Number of the last migration, kept by the database itself; 0 for an empty database. Part of the
  // transaction.
  virtual absl::StatusOr<int64_t> SchemaVersion() = 0;
  virtual absl::Status SetSchemaVersion(int64_t version) = 0;
};

// Wraps a connection; tests inject faults through it.
using Decorator = std::function<std::unique_ptr<Connection>(std::unique_ptr<Connection>)>;

// Marks a kAborted status as the driver's own wish to run the transaction again.
absl::Status Retryable(std::string_view message);
bool IsRetryable(const absl::Status& status);

}  // namespace truepose::store::sql
