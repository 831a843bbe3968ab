#include "server/scheduled_tasks.h"

#include "core/base/status_macros.h"
#include "server/services/recalibration_schedule.h"
#include "server/store/events.h"
#include "server/store/replies.h"
#include "server/store/table_files.h"

namespace truepose::server {
namespace {

using services::IsStopping;
using store::Snapshot;
using store::Transaction;

// About 20 ms of the writer each.
constexpr int64_t kMostOfCommit = 5'000;
constexpr int kMostCommits = 20;

// `forget` gives how many were forgotten.
template <typename HasAny, typename Forget>
absl::Status ForgetAll(store::Store& store, HasAny has_any, Forget forget) {
  for (int i = 0; i < kMostCommits; ++i) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool any, store.Read(has_any));
    if (!any) break;
    TRUEPOSE_RETURN_IF_ERROR(store.Write(forget).status());
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status ForgetOldEvents(store::Store& store) {
  const absl::Time now = store.clock().Now();
  return ForgetAll(
      store,
      [now](Snapshot& snapshot) {
        return store::HasEventsToForget(snapshot, store::EventHistory(), now);
      },
      [](Transaction& transaction) {
        return store::ForgetEvents(transaction, store::EventHistory(), kMostOfCommit);
      });
}

absl::Status ForgetOldReplies(store::Store& store) {
  const absl::Time now = store.clock().Now();
  return ForgetAll(
      store, [now](Snapshot& snapshot) { return store::HasRepliesToForget(snapshot, now); },
      [](Transaction& transaction) { return store::ForgetReplies(transaction, kMostOfCommit); });
}

absl::Status ForgetOldFiles(store::Store& store) {
  const absl::Time now = store.clock().Now();
  return ForgetAll(
      store, [now](Snapshot& snapshot) { return store::HasFilesToForget(snapshot, now); },
      [](Transaction& transaction) { return store::ForgetFile(transaction); });
}

std::vector<Scheduler::Task> ScheduledTasks(store::Store& store) {
  return {{.what = "policies whose interval is over can't raise requests",
           .run =
               [&store](const IsStopping& is_stopping) {
                 return services::RaiseDueRequests(store, is_stopping).status();
               }},
          {.what = "requests can't expire",
           .run =
               [&store](const IsStopping& is_stopping) {
                 return services::ExpireRequests(store, is_stopping).status();
               }},
          {.what = "old events can't be forgotten",
           .run = [&store](const IsStopping&) { return ForgetOldEvents(store); }},
          {.what = "old answers can't be forgotten",
           .run = [&store](const IsStopping&) { return ForgetOldReplies(store); }},
          {.what = "files of deleted tables can't be forgotten",
           .run = [&store](const IsStopping&) { return ForgetOldFiles(store); }}};
}

}  // namespace truepose::server
