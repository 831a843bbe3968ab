// Faults of user input, gathered so that one answer names all of them.
//
// A fault says which field, what was found there and what was expected. A FaultList that is not
// empty becomes an absl::Status whose message has one line a fault and whose payload carries the
// same three fields, so that the boundary (server/rpc/status.cc, client/cli) can map them without
// parsing prose.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"

namespace truepose {

struct Fault {
  std::string field;     // "measurements[17].joint_readings[3]" or "session.csv:18: q4_rad"
  std::string found;     // "3.2 rad"
  std::string expected;  // "at most 3.1 rad"

  bool operator==(const Fault&) const = default;
};

// "session.csv:18: q4_rad: found 'abc', expected a number"
std::string ToString(const Fault& fault);

class FaultList {
 public:
  void Add(std::string field, std::string found, std::string expected);
  void Add(Fault fault);
  // Takes over the faults of `status`, each with `prefix` before its field. A status without faults
  // becomes one fault of the field `prefix` with the status' message. OK adds nothing.
  void AddAll(const absl::Status& status, std::string_view prefix = "");

  bool empty() const { return faults_.empty(); }
  const std::vector<Fault>& faults() const { return faults_; }

  // OK when empty; else `code` with every fault in message and payload. A list longer than 200
  // faults keeps the first 200 and says how many more there are.
  absl::Status ToStatus(absl::StatusCode code = absl::StatusCode::kInvalidArgument) const;

 private:
  std::vector<Fault> faults_;
  size_t hidden_ = 0;  // faults of statuses taken over that had been cut already
};

// A status with one fault.
absl::Status FaultStatus(std::string field, std::string found, std::string expected);

// The faults that a status carries; empty when it carries none.
std::vector<Fault> FaultsOf(const absl::Status& status);

}  // namespace truepose
