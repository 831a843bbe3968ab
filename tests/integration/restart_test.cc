// A server that is stopped and started again, under clients that do not notice more than a pause.
#include <thread>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "client/append_readings.h"
#include "client/wait_for_job.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/expect_status.h"

namespace truepose {
namespace {

using testing::Import;
using testing::IsOk;
using testing::JobRequest;
using testing::MeasuringSession;
using testing::Uuid;

class RestartTest : public testing::ServerFixture {};

// Would catch jobs that are lost at a restart, or a wait that ends with the server it began with.
TEST_F(RestartTest, JobsAndWaitsGoOn) {
  constexpr int kJobs = 4;
  const client::Client client = NewClient();
  Import(client, "arm", Uuid(1), MeasuringSession(300, 1));
  std::vector<std::thread> waits;
  std::vector<v1::JobState> ends(kJobs);
  for (int i = 0; i < kJobs; ++i) {
    ASSERT_THAT(client.CreateCalibrationJob(JobRequest(Uuid(10 + i), "arm", Uuid(1))), IsOk());
    waits.emplace_back([&, i] {
      const auto job = client::WaitForJob(client, absl::StrCat("jobs/", Uuid(10 + i)));
      EXPECT_THAT(job, IsOk());
      if (job.ok()) ends[i] = job->state();
    });
  }
  for (int i = 0; i < 2; ++i) Restart();
  for (std::thread& wait : waits) wait.join();
  EXPECT_EQ(ends, std::vector<v1::JobState>(kJobs, v1::SUCCEEDED));
}

// Would catch an upload that fails, loses or doubles rows because the server went away for a
// moment.
TEST_F(RestartTest, AnUploadGoesOn) {
  const client::Client client = NewClient();
  Import(client, "arm", Uuid(1), MeasuringSession(5, 1));
  v1::CreateSessionRequest session;
  session.set_session_id(Uuid(2));
  session.mutable_session()->set_robot("robots/arm");
  ASSERT_THAT(client.CreateSession(session), IsOk());
  const auto input = MeasuringSession(500, 1);
  const std::vector<v1::Reading> readings(input.readings().begin(), input.readings().end());
  absl::Notification half;
  client::AppendOptions options{.batch_size = 5};
  options.on_progress = [&](int acknowledged, int) {
    if (acknowledged >= 250 && !half.HasBeenNotified()) half.Notify();
  };
  std::thread upload([&] {
    EXPECT_THAT(
        client::AppendReadings(client, absl::StrCat("sessions/", Uuid(2)), readings, options),
        IsOk());
  });
  half.WaitForNotification();
  Restart();
  upload.join();
  v1::SealSessionRequest seal;
  seal.set_name(absl::StrCat("sessions/", Uuid(2)));
  seal.set_reading_count(500);
  const auto sealed = client.SealSession(seal);
  ASSERT_THAT(sealed, IsOk());
  EXPECT_EQ(sealed->digest(), convert::ReadingsDigest(readings));
}

// Would catch a client that says "connection reset" where the server is simply not there.
TEST_F(RestartTest, AClientWithoutAServerSaysWhere) {
  StopServer();
  const auto listed = NewClient().ListRobots({});
  EXPECT_THAT(listed, testing::HasCode(absl::StatusCode::kUnavailable));
  EXPECT_THAT(
      std::string(listed.status().message()),
      ::testing::HasSubstr(absl::StrCat("no Truepose server answers at ", options_.listen)));
}

}  // namespace
}  // namespace truepose
