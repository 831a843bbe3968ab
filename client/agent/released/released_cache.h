// The folder in which released tables of one robot outlast the process, the PC's power and the
// server: {sha256}.table, released.json (what runs and what ran before it), and active.table, a
// link to the file that runs, for programs that open it by themselves.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/agent/released/released_set.h"
#include "client/agent/spool/disk.h"

namespace truepose::agent {

// Of one thread. A process that ends at any point leaves the former state or the new one.
class ReleasedCache {
 public:
  // @param folder is made when there is something to put there. @param robot robots/{robot}
  ReleasedCache(std::string folder, std::string robot, Disk& disk)
      : folder_(std::move(folder)), robot_(std::move(robot)), disk_(disk) {}

  // What released.json lists, the one that runs first; none without the file.
  // @returns kInvalidArgument, kFailedPrecondition as EntriesFromJson, with the file's name.
  absl::StatusOr<std::vector<ReleasedEntry>> Entries() const;
  bool Has(const std::string& sha256) const;
  // As ReleasedSet::Map.
  absl::StatusOr<std::shared_ptr<const ReleasedSet>> Read(const ReleasedEntry& entry) const;

  // Durable when it returns OK. @returns kResourceExhausted or kUnavailable, for the disk.
  absl::Status Put(const std::string& sha256, std::string_view bytes);
  void Remove(const std::string& sha256);
  // sets[0] is what runs from now on; tables of others than `sets` are removed. After an error it
  // may be either; again is right.
  absl::Status Release(const std::vector<ReleasedEntry>& sets);
  // Lets active_path() be that table; OK without a change when it is. For a process that ended
  // within Release, before that. @returns kResourceExhausted or kUnavailable, for the disk.
  absl::Status Link(const std::string& sha256);
  // Where the one that runs can be opened by others.
  std::string active_path() const { return folder_ + "/active.table"; }

 private:
  std::string PathOf(const std::string& sha256) const { return folder_ + "/" + sha256 + ".table"; }
  void RemoveOthers(const std::vector<ReleasedEntry>& sets);

  const std::string folder_, robot_;
  Disk& disk_;
};

}  // namespace truepose::agent
