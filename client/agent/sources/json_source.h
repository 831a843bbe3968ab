// JSON lines from a descriptor, such as standard input or a pipe.
#pragma once

#include <optional>
#include <string>

#include "client/agent/sources/session_feed.h"
#include "client/agent/sources/settled.h"

namespace truepose::agent {

struct JsonSourceOptions {
  int descriptor = 0;                   // of standard input; not closed
  std::string place = "stdin";          // before ":line" in faults
  v1::Session content;                  // fills what a begin leaves empty, and begins without one
  std::optional<SettleOptions> settle;  // only readings of standstills; they need `time`
};

// Reads until the end or a stop (json_line.h has the lines). A reading before any begin begins a
// new session. A line that can't be understood is reported with its number, and the rest goes on;
// so is a session that the sink refuses, whose readings are then left out until the next begin.
// Readings are handed over when nothing more waits to be read: durable without delay when they come
// one by one, in batches when they come fast. At the end the session stays open unless it was
// sealed.
//
// After a restart the one who writes sends a begin with the same id and all readings again: what is
// known has no effect (client/agent/source.h).
class JsonSource : public Source {
 public:
  JsonSource(JsonSourceOptions options, FaultReport report);

  std::string name() const override { return "json " + options_.place; }
  absl::Status Run(ReadingSink& sink, const Stop& stop) override;

 private:
  const JsonSourceOptions options_;
  const FaultReport report_;
};

}  // namespace truepose::agent
