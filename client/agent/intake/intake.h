// The sink of all sources: checks, then spools.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "client/agent/requests/request_book.h"
#include "client/agent/source.h"
#include "client/agent/spool/spool.h"

namespace truepose::agent {

struct IntakeOptions {
  std::string agent;                  // its name: the same key in two agents gives two sessions
  std::map<std::string, int> joints;  // of each robot that it looks after, by robots/{robot}
};

class Intake : public ReadingSink {
 public:
  // `on_change` is told whenever there is something to deliver.
  Intake(IntakeOptions options, Spool& spool, RequestBook& requests,
         std::function<void()> on_change);

  absl::StatusOr<SessionProgress> Begin(const SessionStart& start) override;
  absl::StatusOr<int64_t> Append(const std::string& session, int64_t first_number,
                                 const std::vector<v1::Reading>& readings) override;
  absl::StatusOr<SessionProgress> Seal(const std::string& session, int64_t readings) override;
  absl::StatusOr<MeasuringTask> Task(const std::string& robot) override;

  // @returns kNotFound for a session that is neither here nor done.
  absl::StatusOr<SessionProgress> Progress(const std::string& session) const;
  // Joints of a robot that this agent looks after; kNotFound, and names those that it does.
  absl::StatusOr<int> JointsOf(const std::string& robot) const;

 private:
  absl::StatusOr<std::string> NameFor(const SessionStart& start) const;
  absl::StatusOr<SessionProgress> BeginForRequest(v1::Session content);
  absl::StatusOr<SessionProgress> BeginNamed(v1::Session content, const std::string& request);
  // The newest session of the request that is not sealed, nullptr when there is none.
  Spool::Session OpenSessionOf(const std::string& request) const;
  absl::StatusOr<Spool::Session> Find(const std::string& session) const;

  const IntakeOptions options_;
  Spool& spool_;
  RequestBook& requests_;
  const std::function<void()> on_change_;
};

}  // namespace truepose::agent
