#include "server/jobs/job_state.h"

#include "absl/strings/str_cat.h"

namespace truepose::jobs {
namespace {

bool MayFollow(v1::JobState from, v1::JobState to) {
  switch (from) {
    case v1::PENDING:
      return to == v1::RUNNING || to == v1::CANCELLED || to == v1::FAILED;
    case v1::RUNNING:
      return to == v1::SUCCEEDED || to == v1::FAILED || to == v1::CANCELLED || to == v1::PENDING;
    default:
      return false;
  }
}

}  // namespace

bool IsTerminal(v1::JobState state) {
  return state == v1::SUCCEEDED || state == v1::FAILED || state == v1::CANCELLED;
}

absl::Status CheckTransition(v1::JobState from, v1::JobState to) {
  if (MayFollow(from, to)) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrCat("a job that is ", v1::JobState_Name(from),
                                                    " can't become ", v1::JobState_Name(to)));
}

}  // namespace truepose::jobs
