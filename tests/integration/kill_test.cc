// trueposed killed with -9 and started again. This proves that nothing acknowledged is lost when
// the process dies. It does not prove the same of a power failure: after kill -9 the system still
// writes what the process handed over.
#include <chrono>
#include <random>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "absl/time/clock.h"
#include "client/append_readings.h"
#include "client/pager.h"
#include "client/wait_for_job.h"
#include "convert/run.h"
#include "tests/integration/server_fixture.h"
#include "tests/integration/server_process.h"
#include "tests/server/testing/expect_status.h"

namespace truepose {
namespace {

using testing::Import;
using testing::IsOk;
using testing::JobRequest;
using testing::MeasuringSession;
using testing::ServerProcess;
using testing::TempDir;
using testing::Uuid;

constexpr int kBatch = 3;  // readings, small so that a kill falls between many commits

class KillTest : public ::testing::Test {
 protected:
  // Starts trueposed, on the database of the one before.
  std::unique_ptr<ServerProcess> Start() const {
    auto process = std::make_unique<ServerProcess>(
        folder_, std::vector<std::string>{"--database", folder_.File("t.db")});
    EXPECT_TRUE(process->WaitUntilReady()) << process->Output();
    return process;
  }
  client::Client NewClient(const ServerProcess& process) const {
    return *client::Client::Connect(process.address(), {.call_timeout = std::chrono::seconds(20)});
  }
  int Draw(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }

  TempDir folder_;
  std::mt19937_64 random_{2024};
};

std::vector<v1::Reading> StoredReadings(const client::Client& client, const std::string& session) {
  std::vector<v1::Reading> readings;
  v1::ListReadingsRequest request;
  request.set_session(session);
  const auto status = client::ForEachPage(
      request, [&](const auto& r) { return client.ListReadings(r); },
      [&](const v1::ListReadingsResponse& page) {
        readings.insert(readings.end(), page.readings().begin(), page.readings().end());
        return absl::OkStatus();
      });
  EXPECT_THAT(status, IsOk());
  return readings;
}

// Uploads until the server is killed, a moment after the acknowledgement that reaches `kill_at`.
// @returns how many rows were acknowledged.
int UploadUntilKilled(ServerProcess& process, const std::string& session,
                      const std::vector<v1::Reading>& readings, int kill_at,
                      absl::Duration moment) {
  int acknowledged = 0;
  absl::Notification reached;
  std::thread killer([&] {
    reached.WaitForNotification();
    absl::SleepFor(moment);
    process.Kill();
  });
  client::AppendOptions options{.batch_size = kBatch, .patience = std::chrono::milliseconds(0)};
  options.on_progress = [&](int count, int) {
    acknowledged = count;
    if (count >= kill_at && !reached.HasBeenNotified()) reached.Notify();
  };
  const auto client = client::Client::Connect(process.address());
  client::AppendReadings(*client, session, readings, options).IgnoreError();
  if (!reached.HasBeenNotified()) reached.Notify();
  killer.join();
  return acknowledged;
}

// Every row that was acknowledged is there, rows come in whole batches, and each is what was sent.
void ExpectStored(const std::vector<v1::Reading>& stored, const std::vector<v1::Reading>& sent,
                  int acknowledged) {
  ASSERT_GE(static_cast<int>(stored.size()), acknowledged);
  ASSERT_LE(stored.size(), sent.size());
  EXPECT_TRUE(stored.size() % kBatch == 0 || stored.size() == sent.size())
      << "half a batch was stored";
  for (size_t row = 0; row < stored.size(); ++row) {
    v1::Reading content = stored[row];
    EXPECT_TRUE(content.has_server_time()) << "row " << row;
    content.clear_server_time();
    ASSERT_EQ(content.SerializeAsString(), sent[row].SerializeAsString()) << "row " << row;
  }
}

// Would catch an acknowledgement that leaves before its commit, a half-written batch, and a client
// that can't go on.
TEST_F(KillTest, NothingAcknowledgedIsLostDuringAnImport) {
  auto process = Start();
  const auto input = MeasuringSession(1500, 1);
  const std::vector<v1::Reading> readings(input.readings().begin(), input.readings().end());
  ASSERT_NO_FATAL_FAILURE(Import(NewClient(*process), "arm", Uuid(1), MeasuringSession(5, 1)));
  v1::CreateSessionRequest session;
  session.set_session_id(Uuid(2));
  session.mutable_session()->set_robot("robots/arm");
  ASSERT_THAT(NewClient(*process).CreateSession(session), IsOk());
  const std::string name = absl::StrCat("sessions/", Uuid(2));
  int stored_before = 0;
  for (int kill = 0; kill < 12; ++kill) {
    const int kill_at = stored_before + Draw(1, 100);
    const int acknowledged =
        UploadUntilKilled(*process, name, readings, kill_at, absl::Microseconds(Draw(0, 3000)));
    process = Start();
    const auto stored = StoredReadings(NewClient(*process), name);
    ASSERT_NO_FATAL_FAILURE(ExpectStored(stored, readings, acknowledged)) << "after kill " << kill;
    ASSERT_GE(static_cast<int>(stored.size()), stored_before)
        << "a kill lost rows of an earlier run";
    stored_before = static_cast<int>(stored.size());
  }
  EXPECT_THAT(client::AppendReadings(NewClient(*process), name, readings), IsOk());
  v1::SealSessionRequest seal;
  seal.set_name(name);
  seal.set_reading_count(static_cast<int>(readings.size()));
  const auto sealed = NewClient(*process).SealSession(seal);
  ASSERT_THAT(sealed, IsOk());
  EXPECT_EQ(sealed->digest(), convert::ReadingsDigest(readings));
}

// Would catch a job that is lost, runs for ever, or ends twice when the server dies under it.
// Killed twice at most: a job begun three times without an end is FAILED by design.
TEST_F(KillTest, AJobFinishesThoughItsServerDies) {
  auto process = Start();
  ASSERT_NO_FATAL_FAILURE(Import(NewClient(*process), "arm", Uuid(1), MeasuringSession(600, 1)));
  for (int round = 0; round < 5; ++round) {
    const std::string job_id = Uuid(100 + round);
    ASSERT_THAT(NewClient(*process).CreateCalibrationJob(JobRequest(job_id, "arm", Uuid(1))),
                IsOk());
    for (int kill = 0; kill < 2; ++kill) {
      absl::SleepFor(absl::Milliseconds(Draw(0, 80)));
      process->Kill();
      process = Start();
    }
    const auto job = client::WaitForJob(NewClient(*process), absl::StrCat("jobs/", job_id));
    ASSERT_THAT(job, IsOk());
    EXPECT_EQ(job->state(), v1::SUCCEEDED) << job->DebugString();
    EXPECT_EQ(job->calibration(), "robots/arm/calibrations/1")
        << "a run after a kill gave other bits: equal content is stored once";
  }
  v1::ListCalibrationsRequest request;
  request.set_robot("robots/arm");
  const auto listed = NewClient(*process).ListCalibrations(request);
  ASSERT_THAT(listed, IsOk());
  EXPECT_EQ(listed->calibrations_size(), 1);
}

}  // namespace
}  // namespace truepose
