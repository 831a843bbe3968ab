#include "server/jobs/job_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace truepose::jobs {
namespace {

// Catches an arrow that is missing or too many: every pair of states.
TEST(JobState, OnlyTheseTransitions) {
  const std::set<std::pair<v1::JobState, v1::JobState>> allowed = {
      {v1::PENDING, v1::RUNNING},   {v1::PENDING, v1::CANCELLED}, {v1::PENDING, v1::FAILED},
      {v1::RUNNING, v1::SUCCEEDED}, {v1::RUNNING, v1::FAILED},    {v1::RUNNING, v1::CANCELLED},
      {v1::RUNNING, v1::PENDING},
  };
  for (int from = 0; from < v1::JobState_ARRAYSIZE; ++from) {
    for (int to = 0; to < v1::JobState_ARRAYSIZE; ++to) {
      const std::pair pair{v1::JobState(from), v1::JobState(to)};
      EXPECT_EQ(CheckTransition(pair.first, pair.second).ok(), allowed.count(pair) == 1)
          << from << " to " << to;
    }
  }
}

// Catches a terminal state from which a job goes on.
TEST(JobState, TerminalStatesHaveNoWayOut) {
  for (int from = 0; from < v1::JobState_ARRAYSIZE; ++from) {
    bool goes_on = false;
    for (int to = 0; to < v1::JobState_ARRAYSIZE; ++to) {
      goes_on |= CheckTransition(v1::JobState(from), v1::JobState(to)).ok();
    }
    if (from == v1::JOB_STATE_UNSPECIFIED) continue;
    EXPECT_EQ(IsTerminal(v1::JobState(from)), !goes_on) << from;
  }
}

TEST(JobState, TheMessageNamesBothStates) {
  const absl::Status status = CheckTransition(v1::SUCCEEDED, v1::RUNNING);
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(std::string(status.message()),
              ::testing::AllOf(::testing::HasSubstr("SUCCEEDED"), ::testing::HasSubstr("RUNNING")));
}

}  // namespace
}  // namespace truepose::jobs
