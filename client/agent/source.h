// What brings readings to the agent (a file that grows, a folder, a stream, a simulation, the TCP
// interface), and what they bring them to.
//
// A session's readings count from 1 in the order in which they are handed over. Every call below is
// durable on this machine's disk before it returns OK, and may be repeated: a repeat has no effect
// and the same answer. So a source that broke off asks Begin how many readings the session has, and
// goes on behind them; no reading is lost, none comes twice. Nothing here waits for the server.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/agent/stop.h"
#include "truepose/v1/plant.pb.h"
#include "truepose/v1/session.pb.h"

namespace truepose::agent {

struct SessionStart {
  // robot ("robots/{robot}", one of the configuration) and what else is known: source,
  // extra_columns, purpose, instrument, fixture, operator, joint_source, temperature_c, load_kg,
  // placement, display_name. `name` is ignored.
  v1::Session content;
  // Which session is meant. At most one of them is given, else the session is a new one.
  std::string id = {};   // a UUID in lower case, made by the source
  std::string key = {};  // whatever names it for good, such as a file's path and first line: the
                         // same key and robot give the same session for ever
  // The session answers the robot's open recalibration request; the open session of that request is
  // gone on with. With `id` and `key` empty.
  bool for_request = false;
};

struct SessionProgress {
  std::string session = {};  // sessions/{uuid}
  std::string robot = {};    // robots/{robot}
  int64_t readings = 0;      // durable here
  bool sealed = false;       // here; takes no more readings
  int64_t delivered = 0;     // durable on the server, as it said last
  bool settled = false;      // sealed on the server too
  std::string refusal = {};  // what the server said against it, "" = nothing
};

// What an open recalibration request wants measured.
struct MeasuringTask {
  std::string request = {};   // robots/{robot}/recalibrationRequests/{request}
  std::string reason = {};    // for people
  std::string pose_set = {};  // its name, "" = the request names none
  std::vector<v1::PoseSetPose> poses = {};
  std::string session = {};  // that was begun for it, "" = none yet
};

// May be called by many threads at once. All faults of a call come at once as FaultsOf(status),
// fields as in v1::Session and v1::Reading.
class ReadingSink {
 public:
  virtual ~ReadingSink() = default;

  // Begins a session, or finds the one that is meant and its progress.
  // @returns kInvalidArgument with faults; kNotFound for a robot that this agent doesn't look
  // after;
  //   kFailedPrecondition for `for_request` without an open request; kAlreadyExists for an id whose
  //   session has other values; kResourceExhausted when the spool is full, kUnavailable when its
  //   disk can't be written: try again later.
  virtual absl::StatusOr<SessionProgress> Begin(const SessionStart& start) = 0;

  // Appends readings number first_number, first_number + 1... All or none. Numbers that the session
  // has already are compared, and count as appended when they are the same.
  // @param readings row and server_time are ignored; joints in rad or m.
  // @returns how many readings the session has then; kInvalidArgument with faults
  //   `readings[i].field`; kNotFound for a session; kOutOfRange for a gap, with the number
  //   expected; kAborted for a number that is stored with another content; kFailedPrecondition when
  //   the session is sealed; kResourceExhausted and kUnavailable as Begin. Nothing is appended
  //   then.
  virtual absl::StatusOr<int64_t> Append(const std::string& session, int64_t first_number,
                                         const std::vector<v1::Reading>& readings) = 0;

  // No more readings; it has `readings` of them, at least 1.
  // @returns kNotFound; kInvalidArgument when it has another number of readings; kUnavailable.
  virtual absl::StatusOr<SessionProgress> Seal(const std::string& session, int64_t readings) = 0;

  // @returns kNotFound when no request of this robot is open.
  virtual absl::StatusOr<MeasuringTask> Task(const std::string& robot) = 0;
};

// One configured source. The agent runs each in a thread of its own.
class Source {
 public:
  virtual ~Source() = default;
  // For the log, such as "csv /data/tracker.csv".
  virtual std::string name() const = 0;
  // Hands over what comes until `stop` is requested (OK) or nothing more can come (OK). Waits out
  // kResourceExhausted and kUnavailable of the sink by itself.
  // @returns what a person has to see to, such as a file with faults; the agent logs and reports
  // it,
  //   and goes on with its other sources.
  virtual absl::Status Run(ReadingSink& sink, const Stop& stop) = 0;
};

}  // namespace truepose::agent
