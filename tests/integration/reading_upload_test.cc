// A spool that is uploaded to a real server which restarts, is restored from an older copy, or has
// it all already.
#include "client/reading_upload.h"

#include <cmath>
#include <filesystem>
#include <mutex>
#include <thread>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "client/pager.h"
#include "core/base/error_metadata.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/expect_status.h"

namespace truepose {
namespace {

using testing::HasCode;
using testing::IsOk;
using testing::Uuid;

const char kSource[] = "00000000-0000-4000-8000-0000000000aa";

std::string Session(int number) { return absl::StrCat("sessions/", Uuid(number)); }

// Readings in memory, each with a position that tells its sequence.
class Spool : public client::ReadingSpool {
 public:
  void Add(int session, int count) {
    std::lock_guard lock(mutex_);
    for (int i = 0; i < count; ++i) {
      v1::Reading reading;
      for (int joint = 0; joint < 5; ++joint) reading.add_joints_measured(0.1);
      reading.mutable_position_m()->set_x(1e-3 * static_cast<double>(entries_.size() + 1));
      entries_.emplace_back(session, reading);
    }
  }
  void Change(int64_t sequence) { entries_[sequence - 1].second.mutable_position_m()->set_y(0.5); }
  int64_t last_sequence() const override {
    std::lock_guard lock(mutex_);
    return static_cast<int64_t>(entries_.size());
  }
  absl::StatusOr<client::SpooledReadings> Read(int64_t sequence, int most) override {
    std::lock_guard lock(mutex_);
    const int session = entries_[sequence - 1].first;
    client::SpooledReadings out{Session(session), {}};
    for (size_t i = sequence - 1; i < entries_.size() && most-- > 0; ++i) {
      if (entries_[i].first != session) break;
      out.readings.push_back(entries_[i].second);
    }
    first_reads_.push_back(sequence);
    return out;
  }
  void SetDurable(int64_t sequence) override {
    std::lock_guard lock(mutex_);
    if (sequence >= notify_at_ && notify_at_ > 0 && !reached_.HasBeenNotified()) reached_.Notify();
  }
  void NotifyAt(int64_t sequence) { notify_at_ = sequence; }
  void Wait() { reached_.WaitForNotification(); }
  // Where the last upload began to read.
  std::vector<int64_t> TakeReads() { return std::exchange(first_reads_, {}); }

 private:
  mutable std::mutex mutex_;
  std::vector<std::pair<int, v1::Reading>> entries_;
  std::vector<int64_t> first_reads_;
  int64_t notify_at_ = 0;
  absl::Notification reached_;
};

class ReadingUploadTest : public testing::ServerFixture {
 protected:
  ReadingUploadTest() {
    v1::CreateRobotRequest robot;
    robot.set_robot_id("arm");
    *robot.mutable_nominal() = convert::MeasuringRobot();
    EXPECT_THAT(NewClient().CreateRobot(robot), IsOk());
    AddSession(1);
    AddSession(2);
  }

  void AddSession(int number) {
    v1::CreateSessionRequest session;
    session.set_session_id(Uuid(number));
    session.mutable_session()->set_robot("robots/arm");
    EXPECT_THAT(NewClient().CreateSession(session), IsOk());
  }

  absl::StatusOr<int64_t> Upload(int batch = 7) {
    return client::UploadSpool(NewClient(), kSource, spool_, {.batch_size = batch});
  }

  // A message of session 1, as the spool has it.
  v1::AppendReadingsRequest Message(int first, int count) {
    v1::AppendReadingsRequest batch;
    batch.set_source(kSource);
    batch.set_session(Session(1));
    batch.set_first_sequence(first);
    const auto spooled = spool_.Read(first, count);
    for (const v1::Reading& reading : spooled->readings) *batch.add_readings() = reading;
    return batch;
  }

  // The sequences that a session's readings tell, by row.
  std::vector<int> Stored(int session) {
    const client::Client client = NewClient();
    v1::ListReadingsRequest request;
    request.set_session(Session(session));
    std::vector<int> sequences;
    EXPECT_THAT(
        client::ForEachPage(
            request, [&](const auto& r) { return client.ListReadings(r); },
            [&](const v1::ListReadingsResponse& page) {
              for (const auto& reading : page.readings()) {
                EXPECT_EQ(reading.row(), static_cast<int>(sequences.size()));
                sequences.push_back(static_cast<int>(std::lround(1e3 * reading.position_m().x())));
              }
              return absl::OkStatus();
            }),
        IsOk());
    return sequences;
  }

  Spool spool_;
};

std::vector<int> From(int first, int last) {
  std::vector<int> numbers;
  for (int i = first; i <= last; ++i) numbers.push_back(i);
  return numbers;
}

// Would catch readings that get to another session, or whose order depends on the batches.
TEST_F(ReadingUploadTest, TwoSessionsInterleaved) {
  std::vector<int> one, two;
  for (int sequence = 1; sequence <= 90; ++sequence) {
    const int session = sequence % 10 < 4 ? 1 : 2;
    spool_.Add(session, 1);
    (session == 1 ? one : two).push_back(sequence);
  }
  const auto durable = Upload();
  ASSERT_THAT(durable, IsOk());
  EXPECT_EQ(*durable, 90);
  EXPECT_EQ(Stored(1), one);
  EXPECT_EQ(Stored(2), two);
}

// Would catch an upload that loses, doubles or reorders readings when the server goes away in the
// middle.
TEST_F(ReadingUploadTest, GoesOnAfterARestart) {
  spool_.Add(1, 1500);
  spool_.NotifyAt(300);
  std::thread upload([&] {
    const auto durable = Upload(5);
    EXPECT_THAT(durable, IsOk());
  });
  spool_.Wait();
  Restart();
  upload.join();
  EXPECT_EQ(Stored(1), From(1, 1500));
}

// Would catch a client that sends everything again, and a server that stores it again when one
// does.
TEST_F(ReadingUploadTest, ReplaysHaveNoEffect) {
  spool_.Add(1, 40);
  ASSERT_THAT(Upload(), IsOk());
  spool_.TakeReads();
  ASSERT_THAT(Upload(), IsOk());
  EXPECT_EQ(spool_.TakeReads(), std::vector<int64_t>()) << "the server was asked first";
  for (int replay = 0; replay < 5; ++replay) {
    const auto stream = NewClient().OpenAppendStream();
    for (const int first : {1, 21}) {
      const v1::AppendReadingsRequest batch = Message(first, 20);
      ASSERT_TRUE(stream->Write(batch));
      v1::AppendReadingsResponse acknowledgement;
      ASSERT_TRUE(stream->Read(&acknowledgement));
      EXPECT_EQ(acknowledgement.durable_sequence(), 40);
      EXPECT_EQ(acknowledgement.reading_count(), 40);
    }
    stream->WritesDone();
    EXPECT_THAT(stream->Finish(), IsOk());
    if (replay == 2) Restart();
  }
  EXPECT_EQ(Stored(1), From(1, 40));
}

// Would catch a gap that is filled with what comes, and an answer from which no program learns
// where to go on.
TEST_F(ReadingUploadTest, AGapSaysWhatIsExpected) {
  spool_.Add(1, 10);
  ASSERT_THAT(Upload(), IsOk());
  spool_.Add(1, 5);
  const auto stream = NewClient().OpenAppendStream();
  const v1::AppendReadingsRequest batch = Message(12, 3);
  ASSERT_TRUE(stream->Write(batch));
  v1::AppendReadingsResponse acknowledgement;
  EXPECT_FALSE(stream->Read(&acknowledgement));
  const absl::Status status = stream->Finish();
  EXPECT_THAT(status, HasCode(absl::StatusCode::kOutOfRange));
  EXPECT_EQ(ErrorMetadataOf(status), (ErrorMetadata{{"expected_sequence", "11"}}));
  ASSERT_THAT(Upload(), IsOk());
  EXPECT_EQ(Stored(1), From(1, 15));
}

// Would catch a second spool that goes on under the source of another one.
TEST_F(ReadingUploadTest, OtherContentIsRefused) {
  spool_.Add(1, 10);
  ASSERT_THAT(Upload(), IsOk());
  spool_.Change(4);
  const auto stream = NewClient().OpenAppendStream();
  const v1::AppendReadingsRequest batch = Message(1, 10);
  stream->Write(batch);
  v1::AppendReadingsResponse acknowledgement;
  EXPECT_FALSE(stream->Read(&acknowledgement));
  EXPECT_THAT(stream->Finish(), HasCode(absl::StatusCode::kAborted));
  Spool shorter;
  shorter.Add(1, 3);
  EXPECT_THAT(client::UploadSpool(NewClient(), kSource, shorter),
              HasCode(absl::StatusCode::kFailedPrecondition));
}

// Would catch a restored server whose lost readings are never sent again, or a client that is not
// told that a session is gone.
TEST_F(ReadingUploadTest, ARestoredServerGetsWhatItLacks) {
  spool_.Add(1, 30);
  ASSERT_THAT(Upload(), IsOk());
  StopServer();
  const std::string copy = options_.database + ".copy";
  std::filesystem::copy_file(options_.database, copy);
  Restart();
  AddSession(3);
  spool_.Add(2, 20);
  spool_.Add(3, 10);
  ASSERT_THAT(Upload(), IsOk());
  StopServer();
  for (const char* suffix : {"", "-wal", "-shm"}) {
    std::filesystem::remove(options_.database + suffix);
  }
  std::filesystem::copy_file(copy, options_.database);
  Restart();
  spool_.TakeReads();
  EXPECT_THAT(Upload(), HasCode(absl::StatusCode::kNotFound)) << "session 3 is not in the copy";
  EXPECT_EQ(spool_.TakeReads().front(), 31) << "only what the server lacks";
  AddSession(3);
  const auto durable = Upload();
  ASSERT_THAT(durable, IsOk());
  EXPECT_EQ(*durable, 60);
  EXPECT_EQ(Stored(1), From(1, 30));
  EXPECT_EQ(Stored(2), From(31, 50));
  EXPECT_EQ(Stored(3), From(51, 60));
}

// Would catch options that make an upload hang.
TEST_F(ReadingUploadTest, OptionsAreChecked) {
  EXPECT_THAT(
      client::UploadSpool(NewClient(), kSource, spool_, {.batch_size = 0, .batches_in_flight = 0}),
      testing::HasFaultsAt(std::vector<std::string>{"batch_size", "batches_in_flight"}));
}

}  // namespace
}  // namespace truepose
