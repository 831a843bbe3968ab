// What the scheduler of a server does: policies and requests whose time has come, and what is no
// longer kept.
#pragma once

#include <vector>

#include "server/scheduler.h"
#include "server/store/store.h"

namespace truepose::server {

// The store outlives the tasks. Each looks before it writes.
std::vector<Scheduler::Task> ScheduledTasks(store::Store& store);

// Forgets events beyond the history (store/events.h) and answers beyond their time
// (store/replies.h), in commits of a few thousand, so that no other write waits for long; what is
// left is for the next round.
absl::Status ForgetOldEvents(store::Store& store);
absl::Status ForgetOldReplies(store::Store& store);
// The same for bytes of deleted tables (store/table_files.h), a file a commit.
absl::Status ForgetOldFiles(store::Store& store);

}  // namespace truepose::server
