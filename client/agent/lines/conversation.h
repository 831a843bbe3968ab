// What one connection says: JSON objects in, answers out. docs/agent.md is its documentation.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/agent/lines/agent_status.h"
#include "client/agent/lines/reading_json.h"
#include "client/agent/source.h"

namespace truepose::agent {

// What the lines are about.
struct Desk {
  ReadingSink& sink;
  std::function<AgentStatus()> status;
  std::function<absl::Status(const std::string& robot, const std::string& reason)> decline;
  // Unix time, s.
  std::function<double()> now;
  double largest_clock_difference_s = 0;
  // Each answered error; each reading that is durable.
  std::function<void()> on_refused;
  std::function<void(int64_t)> on_taken;
  // Further messages by their `op`; what they answer may say "ok" itself.
  std::map<std::string, std::function<absl::StatusOr<Json>(const Json& message)>> operations = {};
};

class Conversation {
 public:
  explicit Conversation(const Desk& desk) : desk_(desk) {}

  // Answers each line with one line, in their order; what is said to be done is durable. Readings
  // of one session that follow each other are appended together. A line of blanks gets no answer.
  std::string Answer(const std::vector<std::string>& lines);
  // For a line that is too long to be read.
  std::string AnswerTooLong(size_t most) const;

 private:
  struct Waiting {
    v1::Reading reading;
    Json tag;
    bool is_numbered;  // by its source
  };

  void Take(const std::string& line);
  void TakeReading(const Json& message);
  // Appends what waits and answers for it.
  void Flush();
  void FlushOneByOne(const std::vector<Waiting>& waiting);
  absl::StatusOr<Json> Do(const std::string& op, const Json& message);
  absl::StatusOr<Json> Begin(const Json& message);
  absl::StatusOr<Json> Seal(const Json& message);
  absl::StatusOr<Json> Decline(const Json& message) const;
  absl::StatusOr<Json> Request(const Json& message) const;
  void Reply(absl::StatusOr<Json> answer, const Json& tag);
  std::string SessionOf(JsonFields& fields) const;

  const Desk& desk_;
  std::string session_;      // begun last in this connection
  int64_t next_number_ = 1;  // of session_, for readings without a number
  std::string out_;
  // Readings first_.. of one session.
  std::vector<Waiting> waiting_;
  std::string waiting_session_;
  int64_t waiting_first_ = 0;
};

}  // namespace truepose::agent
