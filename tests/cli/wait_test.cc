#include "client/cli/commands/wait.h"

#include <gtest/gtest.h>

#include "client/cli/outcome.h"
#include "core/base/fault.h"

namespace truepose::cli {
namespace {

v1::CalibrationJob Failed(absl::StatusCode code) {
  v1::CalibrationJob job;
  job.set_name("jobs/1-2");
  job.set_state(v1::FAILED);
  job.mutable_error()->set_code(static_cast<int>(code));
  job.mutable_error()->set_message("why");
  return job;
}

// Would catch a failed job that ends like an unreachable server, a broken database or an unknown
// name.
TEST(StatusOfJob, IsTheJobsAndNotTheServers) {
  for (int code = 1; code <= 16; ++code) {
    const absl::Status status = StatusOfJob(Failed(static_cast<absl::StatusCode>(code)));
    const bool input = code == static_cast<int>(absl::StatusCode::kInvalidArgument);
    EXPECT_EQ(ExitCodeOf(status), input ? 3 : 1) << code;
    EXPECT_EQ(status.message(), "why");
  }
}

// Would catch a code of a newer server that becomes a success here.
TEST(StatusOfJob, AnUnknownCodeIsAFailure) {
  for (const int code : {0, -1, 17, 1000}) {
    EXPECT_EQ(ExitCodeOf(StatusOfJob(Failed(static_cast<absl::StatusCode>(code)))), 1) << code;
  }
}

// Would catch faults lost between the job and the person.
TEST(StatusOfJob, KeepsTheFaults) {
  v1::CalibrationJob job = Failed(absl::StatusCode::kInvalidArgument);
  v1::Fault& fault = *job.mutable_error()->add_faults();
  fault.set_field("sessions[0].readings");
  fault.set_found("none");
  fault.set_expected("some");
  const std::vector<Fault> faults = FaultsOf(StatusOfJob(job));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0], (Fault{"sessions[0].readings", "none", "some"}));
}

TEST(StatusOfJob, KnowsSuccessAndCancel) {
  v1::CalibrationJob job;
  job.set_name("jobs/1-2");
  job.set_state(v1::SUCCEEDED);
  EXPECT_TRUE(StatusOfJob(job).ok());
  job.set_state(v1::CANCELLED);
  EXPECT_EQ(StatusOfJob(job).message(), "job 1-2 was cancelled");
  EXPECT_EQ(ExitCodeOf(StatusOfJob(job)), 1);
}

}  // namespace
}  // namespace truepose::cli
