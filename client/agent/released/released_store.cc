#include "client/agent/released/released_store.h"

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

using Set = std::shared_ptr<const ReleasedSet>;

// The current one becomes the newest of the former ones, unless it is of the same calibration.
std::vector<Set> FormerBehind(const ReleasedState& state, const Set& next) {
  std::vector<Set> former;
  const auto keep = [&](const Set& set) {
    bool known = set == nullptr || set->entry().calibration == next->entry().calibration;
    for (const Set& other : former)
      known |= !known && other->entry().calibration == set->entry().calibration;
    if (!known && former.size() < kFormerSets) former.push_back(set);
  };
  keep(state.current);
  for (const Set& set : state.former) keep(set);
  return former;
}

std::string NameOf(const ReleasedEntry& entry) {
  return absl::StrCat(ShortName(entry.calibration), " (made active ", TimeText(entry.activated_us),
                      ", table ", entry.sha256.substr(0, 12), ")");
}

}  // namespace

bool IsForGood(const absl::Status& status) {
  return absl::IsFailedPrecondition(status) || absl::IsOutOfRange(status);
}

std::shared_ptr<const ReleasedState> ReleasedStore::state() const {
  std::lock_guard lock(mutex_);
  return state_;
}

// The old state is let go outside of the lock, since that may unmap a table.
void ReleasedStore::Change(const std::function<void(ReleasedState&)>& change) {
  std::shared_ptr<const ReleasedState> old;
  std::lock_guard lock(mutex_);
  const auto next = std::make_shared<ReleasedState>(*state_);
  change(*next);
  old = std::exchange(state_, next);
}

void ReleasedStore::SetProblem(const std::string& problem) {
  const auto now = state();
  if (now->problem == problem && now->waiting.empty()) return;
  Change([&](ReleasedState& state) {
    state.problem = problem;
    state.waiting.clear();
  });
  if (!problem.empty() && problem != now->problem) warn_(problem);
}

void ReleasedStore::SetWaiting(const std::string& waiting) {
  const auto now = state();
  if (now->waiting == waiting && now->problem.empty()) return;
  Change([&](ReleasedState& state) {
    state.waiting = waiting;
    state.problem.clear();
  });
  if (!waiting.empty()) log_(absl::StrCat("no other table to run: ", waiting));
}

void ReleasedStore::SetControllerState(const std::string& controller_state) {
  Change([&](ReleasedState& state) { state.controller_state = controller_state; });
}

void ReleasedStore::Load() {
  const auto entries = cache_.Entries();
  if (!entries.ok()) return SetProblem(std::string(entries.status().message()));
  ReleasedState loaded;
  for (size_t i = 0; i < entries->size(); ++i) {
    const auto set = cache_.Read((*entries)[i]);
    if (!set.ok())
      SetProblem(absl::StrCat("the cached table of ", ShortName((*entries)[i].calibration),
                              " is not used: ", std::string(set.status().message())));
    if (set.ok() && i == 0) loaded.current = *set;
    if (set.ok() && i > 0) loaded.former.push_back(*set);
  }
  Change([&](ReleasedState& state) {
    state.current = loaded.current;
    state.former = loaded.former;
    if (state.current != nullptr) state.path = cache_.active_path();
  });
  if (loaded.current == nullptr) return;
  const absl::Status linked = cache_.Link(loaded.current->entry().sha256);
  if (!linked.ok()) SetProblem(std::string(linked.message()));
  log_(absl::StrCat("runs ", NameOf(loaded.current->entry()), " from the cache"));
}

absl::StatusOr<Set> ReleasedStore::Obtain(const ReleasedEntry& offered, const Fetch& fetch) {
  if (!IsDigest(offered.sha256))
    return absl::FailedPreconditionError(
        absl::StrCat("sha256: found '", offered.sha256, "', expected 64 digits of lower-case hex"));
  if (cache_.Has(offered.sha256)) {
    auto cached = cache_.Read(offered);
    if (cached.ok()) return cached;
    log_(absl::StrCat("the cached table of ", ShortName(offered.calibration),
                      " is fetched again: ", std::string(cached.status().message())));
  }
  const absl::StatusOr<std::string> bytes = fetch();
  if (!bytes.ok())
    return absl::UnavailableError(
        absl::StrCat("it can't be fetched: ", std::string(bytes.status().message())));
  TRUEPOSE_RETURN_IF_ERROR(cache_.Put(offered.sha256, *bytes));
  auto fetched = cache_.Read(offered);
  if (!fetched.ok()) cache_.Remove(offered.sha256);
  return fetched;
}

absl::Status ReleasedStore::Take(const ReleasedEntry& offered, const Fetch& fetch) {
  const auto now = state();
  if (now->current != nullptr && IsOlder(offered, now->current->entry()))
    return absl::OutOfRangeError(
        absl::StrCat("older than ", NameOf(now->current->entry()),
                     ", which runs: the server was restored from an older copy?"));
  TRUEPOSE_ASSIGN_OR_RETURN(const Set set, Obtain(offered, fetch));
  const std::vector<Set> former = FormerBehind(*now, set);
  std::vector<ReleasedEntry> entries = {offered};
  for (const Set& one : former) entries.push_back(one->entry());
  TRUEPOSE_RETURN_IF_ERROR(cache_.Release(entries));
  Change([&](ReleasedState& state) {
    state.current = set;
    state.former = former;
    state.path = cache_.active_path();
    state.problem.clear();
    state.waiting.clear();
    // It was said of what the controller had been given by then.
    state.controller_state.clear();
  });
  log_(absl::StrCat("runs ", NameOf(offered)));
  return absl::OkStatus();
}

absl::Status ReleasedStore::Offer(const ReleasedEntry& offered, const Fetch& fetch) {
  const auto now = state();
  if (now->current != nullptr && now->current->entry() == offered) {
    SetProblem("");
    return absl::OkStatus();
  }
  const absl::Status status = offered == refused_ ? refusal_ : Take(offered, fetch);
  if (!status.ok())
    SetProblem(absl::StrCat("refused ", NameOf(offered), ": ", std::string(status.message())));
  refused_ = IsForGood(status) ? offered : ReleasedEntry();
  refusal_ = status;
  return status;
}

}  // namespace truepose::agent
