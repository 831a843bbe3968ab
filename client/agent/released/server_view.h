// What a server says of one robot, gathered from its watch: which table it has released.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "client/agent/released/released_entry.h"
#include "truepose/v1/watch.pb.h"

namespace truepose::agent {

class ServerView {
 public:
  // The kinds whose events it wants.
  static v1::WatchRequest RequestOf(const std::string& robot);

  // Of a stream of a Watch, in its order; a new snapshot takes the place of all that was known.
  // @returns whether the view is that of a commit, so that it may be acted upon.
  bool Take(const v1::WatchResponse& response);
  // The stream broke; a snapshot that was under way begins again.
  void OnBreak() { in_snapshot_ = false; }

  // The table that the robot is to run: that of its active calibration, once it is READY.
  std::optional<ReleasedEntry> Released() const;
  // Why there is none, in words for a person.
  std::string WhyNone() const;
  // It is a fault: the table of the active calibration could not be made.
  bool HasFailed() const;
  const std::string& active_calibration() const { return robot_.active_calibration(); }

 private:
  // One that has not FAILED if there is one; null: none at all.
  const v1::CompensationTable* TableOfActive() const;
  // When a calibration was made active last, and by which commit.
  struct Activation {
    int64_t time_us = 0, revision = 0;
  };

  void TakeEvent(const v1::WatchEvent& event);

  bool in_snapshot_ = false;
  v1::Robot robot_;
  std::map<std::string, v1::CompensationTable> tables_;
  std::map<std::string, Activation> activations_;
};

}  // namespace truepose::agent
