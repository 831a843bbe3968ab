// A server whose disk is full: reads go on, writes are refused with what to do, and all is well
// when there is space again.
#include <iostream>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "absl/time/clock.h"
#include "client/append_readings.h"
#include "client/wait_for_job.h"
#include "tests/integration/effects.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/expect_status.h"
#include "tests/store/power/power_vfs.h"

namespace truepose {
namespace {

using testing::HasCode;
using testing::IsOk;
using testing::Uuid;

class DiskFull : public testing::ServerFixture {
 protected:
  DiskFull() {
    StopServer();  // its connections are not on the simulated disk
    vfs_ = std::make_unique<store::PowerVfs>(disk_);
    Restart();
    testing::Import(NewClient(), "arm", Uuid(1), testing::MeasuringSession(60, 1));
    v1::CreateSessionRequest session;
    session.set_session_id(Uuid(2));
    session.mutable_session()->set_robot("robots/arm");
    EXPECT_THAT(NewClient().CreateSession(session), IsOk());
  }
  ~DiskFull() override { StopServer(); }

  // Appends batch `number` of ten readings to session 2.
  absl::Status Append(int number) const {
    v1::SessionInput input = testing::MeasuringSession(10, number);
    v1::AppendReadingsRequest batch;
    batch.set_source(Uuid(9));
    batch.set_session(absl::StrCat("sessions/", Uuid(2)));
    batch.set_first_sequence(1 + 10 * number);
    *batch.mutable_readings() = input.readings();
    const auto stream = NewClient().OpenAppendStream();
    v1::AppendReadingsResponse acknowledgement;
    stream->Write(batch);
    stream->WritesDone();
    while (stream->Read(&acknowledgement)) {
    }
    return stream->Finish();
  }
  int StoredReadings() const {
    v1::GetSessionRequest request;
    request.set_name(absl::StrCat("sessions/", Uuid(2)));
    const auto session = NewClient().GetSession(request);
    EXPECT_THAT(session, IsOk());
    return session.ok() ? session->reading_count() : -1;
  }

  absl::Notification full_;
  store::SimulatedDisk disk_{5};
  std::unique_ptr<store::PowerVfs> vfs_;
};

// Would catch a refusal that doesn't say what to do, reads that fail with the writes, effects of
// refused requests, acknowledged ones that are lost, and a server or a job that stays down after
// space has come back.
TEST_F(DiskFull, ReadsGoOnAndWritesComeBack) {
  disk_.SetFull(true);
  int appended = 0;
  absl::Status refused;
  // What the files have room for still goes in.
  while ((refused = Append(appended)).ok() && appended < 10'000) ++appended;
  EXPECT_THAT(refused, HasCode(absl::StatusCode::kResourceExhausted));
  EXPECT_THAT(std::string(refused.message()), ::testing::HasSubstr("disk is full"));
  EXPECT_THAT(std::string(refused.message()), ::testing::HasSubstr("Free space"));
  const auto job = NewClient().CreateCalibrationJob(testing::JobRequest(Uuid(1), "arm", Uuid(1)));
  EXPECT_THAT(job, HasCode(absl::StatusCode::kResourceExhausted));
  EXPECT_EQ(StoredReadings(), 10 * appended);
  EXPECT_THAT(NewClient().ListRobots({}), IsOk());
  EXPECT_FALSE(testing::EventsAfter(options_.listen, 1).empty()) << "watches go on";
  disk_.SetFull(false);
  const absl::Time space = absl::Now();
  EXPECT_THAT(Append(appended), IsOk());
  EXPECT_EQ(StoredReadings(), 10 * (appended + 1));
  EXPECT_LT(absl::Now() - space, absl::Seconds(5));
  std::cout << "written again " << absl::Now() - space << " after there was space\n";
}

// Would catch a job that is lost, or fails, because its states can't be written for a while.
TEST_F(DiskFull, AJobEndsWhenThereIsSpace) {
  runner_.calibrate = [this](const v1::CalibrationInput&, const jobs::RunnerHooks&) {
    disk_.SetFull(true);
    full_.Notify();
    return absl::StatusOr<v1::Calibration>(absl::InvalidArgumentError("its end is to be stored"));
  };
  Restart();
  ASSERT_THAT(NewClient().CreateCalibrationJob(testing::JobRequest(Uuid(1), "arm", Uuid(1))),
              IsOk());
  full_.WaitForNotification();
  int appended = 0;
  while (Append(appended).ok()) ++appended;
  disk_.SetFull(false);
  const absl::Time space = absl::Now();
  const auto job = client::WaitForJob(NewClient(), absl::StrCat("jobs/", Uuid(1)));
  ASSERT_THAT(job, IsOk());
  EXPECT_EQ(job->state(), v1::FAILED) << "by its runner";
  EXPECT_EQ(job->attempts(), 1);
  EXPECT_LT(absl::Now() - space, absl::Seconds(5));
  std::cout << "the job ended " << absl::Now() - space << " after there was space\n";
}

}  // namespace
}  // namespace truepose
