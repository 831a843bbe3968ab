#include "client/append_readings.h"

#include <map>
#include <mutex>

#include "gmock/gmock.h"
#include "tests/client/fake_server.h"
#include "truepose/v1/services.grpc.pb.h"

namespace truepose::client {
namespace {

using Stream = grpc::ServerReaderWriter<v1::AppendReadingsResponse, v1::AppendReadingsRequest>;

// Keeps rows as the real one does, and breaks streams when it is told to.
class FakeSessions : public v1::SessionService::Service {
 public:
  // Of each stream, the batches that are acknowledged before it breaks. Streams beyond the list
  // never break.
  std::vector<int> breaks;
  // A stream breaks after the batch was stored: its acknowledgement is lost.
  bool loses_acknowledgement = false;
  std::map<int, std::string> rows;
  std::vector<int> first_rows;  // of each batch that came
  int streams = 0;

  grpc::Status AppendReadings(grpc::ServerContext*, Stream* stream) override {
    std::lock_guard lock(mutex_);
    const int stream_number = streams++;
    int left = stream_number < static_cast<int>(breaks.size()) ? breaks[stream_number] : 1'000'000;
    v1::AppendReadingsRequest batch;
    while (stream->Read(&batch)) {
      first_rows.push_back(batch.readings(0).row());
      const bool broken = left-- == 0;
      if (broken && !loses_acknowledgement)
        return grpc::Status(grpc::StatusCode::UNAVAILABLE, "broken");
      if (!Store(batch)) return grpc::Status(grpc::StatusCode::ABORTED, "another content");
      if (broken) return grpc::Status(grpc::StatusCode::UNAVAILABLE, "broken");
      v1::AppendReadingsResponse acknowledgement;
      acknowledgement.set_reading_count(rows.size());
      stream->Write(acknowledgement);
    }
    return grpc::Status::OK;
  }

  grpc::Status GetSession(grpc::ServerContext*, const v1::GetSessionRequest* request,
                          v1::Session* reply) override {
    reply->set_name(request->name());
    reply->set_reading_count(rows.size());
    return grpc::Status::OK;
  }

 private:
  bool Store(const v1::AppendReadingsRequest& batch) {
    for (const v1::Reading& reading : batch.readings()) {
      const std::string content = reading.SerializeAsString();
      if (rows.emplace(reading.row(), content).first->second != content) return false;
    }
    return true;
  }

  std::mutex mutex_;
};

std::vector<v1::Reading> Readings(int count, double x = 1.0) {
  std::vector<v1::Reading> readings(count);
  for (int row = 0; row < count; ++row) {
    readings[row].set_row(row);
    readings[row].mutable_position_m()->set_x(x);
  }
  return readings;
}

class AppendReadingsTest : public ::testing::Test {
 protected:
  absl::StatusOr<int> Append(const std::vector<v1::Reading>& readings) {
    return AppendReadings(client_, "sessions/s", readings, options_);
  }

  FakeSessions fake_;
  testing::FakeServer server_{fake_};
  Client client_ = server_.MakeClient();
  AppendOptions options_{.batch_size = 10, .batches_in_flight = 3};
};

// Would catch a last batch that is lost, or rows that come twice without need.
TEST_F(AppendReadingsTest, SendsEveryRowOnce) {
  std::vector<int> progress;
  options_.on_progress = [&](int acknowledged, int total) {
    EXPECT_EQ(total, 57);
    progress.push_back(acknowledged);
  };
  EXPECT_EQ(*Append(Readings(57)), 57);
  EXPECT_EQ(fake_.rows.size(), 57u);
  EXPECT_EQ(fake_.first_rows, (std::vector<int>{0, 10, 20, 30, 40, 50}));
  EXPECT_EQ(progress, (std::vector<int>{10, 20, 30, 40, 50, 57}));
}

// Would catch an upload that begins again or leaves a hole when the connection breaks.
TEST_F(AppendReadingsTest, GoesOnBehindTheLastAcknowledgement) {
  fake_.breaks = {2, 0, 1};
  EXPECT_EQ(*Append(Readings(57)), 57);
  EXPECT_EQ(fake_.rows.size(), 57u);
  EXPECT_EQ(fake_.streams, 4);
  EXPECT_EQ(fake_.first_rows, (std::vector<int>{0, 10, 20, 20, 20, 30, 30, 40, 50}));
}

// Would catch a batch that counts as lost although it was stored: it is sent again and must be
// accepted.
TEST_F(AppendReadingsTest, ALostAcknowledgementDoesNoHarm) {
  fake_.breaks = {1, 1};
  fake_.loses_acknowledgement = true;
  EXPECT_EQ(*Append(Readings(45)), 45);
  EXPECT_EQ(fake_.rows.size(), 45u);
}

// Would catch a session that is mixed from two files: the stored part is compared from row 0.
TEST_F(AppendReadingsTest, ReadingsOfAnotherFileAreAborted) {
  ASSERT_THAT(Append(Readings(20)), ::testing::Truly([](const auto& r) { return r.ok(); }));
  auto other = Readings(40);
  other[3].mutable_position_m()->set_x(2.0);
  EXPECT_TRUE(absl::IsAborted(Append(other).status()));
  EXPECT_EQ(fake_.rows.size(), 20u);
  EXPECT_EQ(*Append(Readings(40)), 40);
}

// Would catch an upload that goes on for ever, or one that gives up on a pause the caller has
// patience for.
TEST_F(AppendReadingsTest, GivesUpWhenPatienceEnds) {
  fake_.breaks = std::vector<int>(1000, 0);
  options_.patience = std::chrono::milliseconds(500);
  EXPECT_TRUE(absl::IsUnavailable(Append(Readings(20)).status()));
  EXPECT_GE(fake_.streams, 2);
}

TEST_F(AppendReadingsTest, NoReadingsIsACountOnly) {
  EXPECT_EQ(*Append({}), 0);
  EXPECT_EQ(fake_.streams, 0);
}

// Would catch an endless loop on a batch of nothing.
TEST_F(AppendReadingsTest, OptionsAreChecked) {
  options_.batch_size = 0;
  options_.batches_in_flight = 0;
  const absl::Status status = Append(Readings(20)).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  EXPECT_THAT(std::string(status.message()),
              ::testing::AllOf(::testing::HasSubstr("batch_size"),
                               ::testing::HasSubstr("batches_in_flight")));
}

}  // namespace
}  // namespace truepose::client
