// One session of a source: collects readings into batches, waits while the sink can't take them,
// and leaves out single readings that it refuses.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "client/agent/source.h"
#include "core/base/fault.h"

namespace truepose::agent {

// Told of everything in a source's input that was left out; its field begins with the place, such
// as
// "/data/a.csv:17".
using FaultReport = std::function<void(const Fault&)>;

class SessionFeed {
 public:
  // All have to outlive it. @param place of the input, before ":line" in faults.
  SessionFeed(ReadingSink& sink, const Stop& stop, std::string place, const FaultReport& report);

  // Begins the session or finds it. @returns the sink's status, kCancelled when it had to wait and
  // `stop` was requested.
  absl::Status Begin(const SessionStart& start);
  bool begun() const { return !progress_.session.empty(); }
  // It was sealed before we came: nothing can be added, and nothing need be.
  bool was_sealed() const { return progress_.sealed; }
  // Readings that it had when Begin found it.
  int64_t readings_before() const { return progress_.readings; }
  const std::string& session() const { return progress_.session; }

  // Goes on behind the readings that the session has, for who makes readings instead of reading
  // them again. @returns how many those are. @pre nothing was added yet.
  int64_t GoOn() { return readings_ = progress_.readings; }

  // Takes a reading of that line; hands the batch over when it is full. Readings that the sink
  // refuses are reported with their line and left out; the others get the numbers behind the last
  // one. @returns as Begin; what it says is of the whole session then.
  absl::Status Add(v1::Reading reading, int64_t line);
  // Hands over what was taken.
  absl::Status Flush();
  // The same, and seals; a session without a reading stays open.
  absl::Status Seal();

  int64_t readings() const { return readings_; }

 private:
  absl::Status Append();
  // @returns false when no fault names a reading.
  bool LeaveOutFaulty(const absl::Status& status);
  template <class Call>
  auto WaitFor(const Call& call) -> decltype(call());

  ReadingSink& sink_;
  const Stop& stop_;
  const std::string place_;
  const FaultReport& report_;
  SessionProgress progress_;
  int64_t readings_ = 0;  // that the sink has of us
  std::vector<v1::Reading> batch_;
  std::vector<int64_t> lines_;  // of batch_
};

}  // namespace truepose::agent
