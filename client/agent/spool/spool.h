// All sessions of an agent that the server may still need.
//
// Open -> sealed -> done. A session that is done is sealed on the server as well; its file is kept
// for a while, since a server that is restored from an older copy has it no more.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/agent/spool/disk.h"
#include "client/agent/spool/folder_lock.h"
#include "client/agent/spool/session_file.h"

namespace truepose::agent {

struct SpoolOptions {
  std::string folder;                        // made when it is not there, with mode 0700
  int64_t largest_bytes = int64_t{1} << 30;  // of all sessions, done or not
};

// A done session, as its file's name and times tell.
struct DoneSession {
  std::string session;                           // sessions/{uuid}
  std::chrono::system_clock::time_point sealed;  // on the server: when SetDone was called
  int64_t bytes = 0;
};

// May be used by many threads at once.
class Spool {
 public:
  using Session = std::shared_ptr<SessionFile>;

  // Reads all sessions that are not done. What can't be read is left as it is, with a line in
  // notes(); what a crash left half written is cut (session_file.h).
  // @returns kFailedPrecondition when another agent has the folder, kUnavailable.
  static absl::StatusOr<std::unique_ptr<Spool>> Open(const SpoolOptions& options, Disk& disk);

  // The session of content.name(), new or there already.
  // @returns kAlreadyExists when it is there with other values; kFailedPrecondition when it is
  // done;
  //   kResourceExhausted, kUnavailable.
  absl::StatusOr<Session> Begin(const v1::Session& content, const std::string& request);
  // nullptr when there is none that is not done.
  Session Find(const std::string& name) const;
  // Not done, those that were begun first first.
  std::vector<Session> Sessions() const;

  // The server has sealed it.
  absl::Status SetDone(const std::string& name);
  std::vector<DoneSession> Done() const;
  bool IsDone(const std::string& name) const;
  // Of a done session, which is read for it.
  absl::StatusOr<int64_t> DoneReadings(const std::string& name) const;
  // Back among the sessions: the server has it no more.
  absl::StatusOr<Session> Reopen(const std::string& name);
  // Takes a done session's file away.
  absl::Status Remove(const std::string& name);
  // Takes away an open session without readings.
  absl::Status RemoveEmpty(const std::string& name);

  int64_t used_bytes() const { return budget_.used(); }
  int64_t largest_bytes() const { return budget_.limit(); }
  const std::string& folder() const { return folder_; }
  Disk& disk() const { return disk_; }
  // What a person should know of the start: cut ends, files that can't be read.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  Spool(const SpoolOptions& options, Disk& disk, std::unique_ptr<FolderLock> lock);
  absl::Status Load();
  absl::Status LoadOne(const std::string& file);
  std::string PathOf(const std::string& name, const char* suffix) const;

  Disk& disk_;
  const std::string folder_, sessions_folder_;
  const std::unique_ptr<FolderLock> lock_;
  Budget budget_;
  std::vector<std::string> notes_;
  mutable std::mutex mutex_;
  std::map<std::string, Session> sessions_;  // by name
  std::vector<std::string> order_;           // their names as they were begun
  std::map<std::string, DoneSession> done_;
};

}  // namespace truepose::agent
