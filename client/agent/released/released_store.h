// What one robot runs: the released table in use, those before it, and why a newer one isn't.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/agent/released/released_cache.h"

namespace truepose::agent {

// Of one moment, as a whole. Immutable.
struct ReleasedState {
  std::shared_ptr<const ReleasedSet> current = nullptr;  // null: none yet
  // What ran before it, newest first, at most kFormerSets; each calibration once.
  std::vector<std::shared_ptr<const ReleasedSet>> former = {};
  std::string path = {};  // of `current`, for programs that open it by themselves
  std::string problem =
      {};  // what is wrong with what was released, or with the cache; "" = nothing
  std::string waiting = {};  // why the server has released nothing else, or nothing; "" = it has
  std::string controller_state = {};  // AgentReport.controller_state, by the last read-back
};

inline constexpr size_t kFormerSets = 3;

// Of an Offer: another try with the same would end alike.
bool IsForGood(const absl::Status& status);

// state() from any thread at any time, never waiting for the disk; the rest from one thread.
class ReleasedStore {
 public:
  using Fetch = std::function<absl::StatusOr<std::string>()>;

  // @param warn gets what becomes `problem`; null: `log` gets that as well.
  ReleasedStore(ReleasedCache cache, std::function<void(const std::string&)> log,
                std::function<void(const std::string&)> warn = nullptr)
      : cache_(std::move(cache)), log_(std::move(log)), warn_(warn ? std::move(warn) : log_) {}

  // From the cache what ran last. A table there that can't be used is not, and `problem` says why:
  // one that was replaced does not come back for it. `path` is the table that runs also when the
  // process before ended in the middle of a swap.
  void Load();

  // What the server has released now. Runs it, from the cache if it is there, else by `fetch`; all
  // readers see it at once when this returns OK, and it outlasts a failure of power. Else
  // everything stays as it was but for `problem`.
  // What IsForGood() is refused without a look when it is offered again.
  // @returns kOutOfRange when it was made active before what runs (IsOlder); kFailedPrecondition
  //   when it is for something else than this robot or its sha256 is none; kDataLoss for bytes that
  //   are not what was released; kUnavailable when `fetch` fails, with its words; the disk's
  //   errors.
  absl::Status Offer(const ReleasedEntry& offered, const Fetch& fetch);

  // The server has nothing to offer, and why. What was wrong with an earlier offer is over.
  void SetWaiting(const std::string& waiting);
  // What is active can't be run, and why: a `problem` until something else is offered.
  void SetProblem(const std::string& problem);
  // From any thread.
  void SetControllerState(const std::string& controller_state);

  // Never null.
  std::shared_ptr<const ReleasedState> state() const;

 private:
  absl::StatusOr<std::shared_ptr<const ReleasedSet>> Obtain(const ReleasedEntry& offered,
                                                            const Fetch& fetch);
  absl::Status Take(const ReleasedEntry& offered, const Fetch& fetch);
  void Change(const std::function<void(ReleasedState&)>& change);

  ReleasedCache cache_;
  const std::function<void(const std::string&)> log_, warn_;
  ReleasedEntry refused_;
  absl::Status refusal_;  // of refused_
  mutable std::mutex mutex_;
  std::shared_ptr<const ReleasedState> state_ = std::make_shared<ReleasedState>();
};

}  // namespace truepose::agent
