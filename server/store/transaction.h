// What a closure of Store::Read and Store::Write works on. Only repositories look at sql().
#pragma once

#include <cstdint>

#include "absl/time/time.h"
#include "server/store/sql/connection.h"

namespace truepose::store {

// One consistent state of the whole store.
class Snapshot {
 public:
  explicit Snapshot(sql::Connection& connection) : connection_(connection) {}
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

  sql::Connection& sql() { return connection_; }

 private:
  sql::Connection& connection_;
};

// A snapshot that can be changed. What is written becomes visible and durable with the commit, or
// not at all.
class Transaction : public Snapshot {
 public:
  Transaction(sql::Connection& connection, int64_t revision, absl::Time now)
      : Snapshot(connection), revision_(revision), now_(now) {}

  // Revision that the commit will have, store-wide and monotonic; shared by the closures of one
  // commit.
  int64_t revision() const { return revision_; }
  // The one time of everything written here.
  absl::Time now() const { return now_; }

 private:
  int64_t revision_;
  absl::Time now_;
};

}  // namespace truepose::store
