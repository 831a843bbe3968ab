#include "server/store/group_commit.h"

#include <algorithm>

#include "core/base/status_macros.h"
#include "server/store/sql/query.h"
#include "server/store/sql/transaction.h"

namespace truepose::store {
namespace {

// A driver that wants a transaction again is believed a few times.
constexpr int kMostRuns = 5;

absl::Status RunInSavepoint(Transaction& transaction, Work& work) {
  TRUEPOSE_ASSIGN_OR_RETURN(sql::Savepoint savepoint, sql::Savepoint::Begin(transaction.sql()));
  work.result = work.closure(transaction);
  return work.result.ok() ? savepoint.Release() : savepoint.RollBack();
}

// OK: the results hold. Otherwise nothing is stored, whatever the results say.
absl::Status TryGroup(sql::Connection& connection, const Clock& clock,
                      std::span<Work* const> group) {
  TRUEPOSE_ASSIGN_OR_RETURN(sql::Transaction commit,
                            sql::Transaction::Begin(connection, sql::Access::kWrite));
  TRUEPOSE_ASSIGN_OR_RETURN(
      const int64_t revision,
      sql::QueryInt64(connection,
                      "UPDATE store SET revision = revision + 1 WHERE id = 1 RETURNING revision"));
  Transaction transaction(connection, revision, clock.Now());
  for (Work* work : group) TRUEPOSE_RETURN_IF_ERROR(RunInSavepoint(transaction, *work));
  if (std::none_of(group.begin(), group.end(),
                   [](const Work* work) { return work->result.ok(); })) {
    return absl::OkStatus();
  }
  return commit.Commit();
}

void RunAlone(sql::Connection& connection, const Clock& clock, Work& work) {
  Work* const group[] = {&work};
  for (int run = 0; run < kMostRuns; ++run) {
    const absl::Status status = TryGroup(connection, clock, group);
    if (!status.ok()) work.result = status;
    if (!sql::IsRetryable(work.result)) return;
  }
}

}  // namespace

void CommitGroup(sql::Connection& connection, const Clock& clock, std::span<Work* const> group) {
  const bool together = group.size() > 1 && TryGroup(connection, clock, group).ok();
  for (Work* work : group) {
    if (!together || sql::IsRetryable(work->result)) RunAlone(connection, clock, *work);
  }
}

}  // namespace truepose::store
