// The watch of a plant over a real server: ordered, without gap or repeat, resumable.
#include <grpcpp/grpcpp.h>

#include <map>
#include <thread>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/status.h"
#include "core/base/error_metadata.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/examples.h"
#include "tests/server/testing/expect_status.h"
#include "truepose/v1/plant_services.grpc.pb.h"
#include "truepose/v1/watch_services.grpc.pb.h"

namespace truepose {
namespace {

using testing::IsOk;

// What a client that follows one watch knows.
struct Follower {
  std::map<std::string, int64_t> revisions;  // of each resource, the latest seen
  int64_t resume = 0;
  std::string epoch;
  int events = 0;

  // A resource never steps back, an event never comes twice, responses never step back.
  void Take(const v1::WatchResponse& response) {
    epoch = response.epoch();
    if (response.revision() > 0) {
      EXPECT_GE(response.revision(), resume);
      resume = response.revision();
    }
    for (const v1::WatchEvent& event : response.events()) {
      const auto [known, is_new] = revisions.try_emplace(event.name(), event.revision());
      if (!is_new) {
        EXPECT_GT(event.revision(), known->second) << event.name();
      }
      known->second = event.revision();
      ++events;
    }
  }
};

class WatchTest : public testing::ServerFixture {
 protected:
  std::shared_ptr<grpc::Channel> Channel() const {
    return grpc::CreateChannel(options_.listen, grpc::InsecureChannelCredentials());
  }

  // Instruments are the quickest resources to change.
  void Rename(const std::string& id, int to) {
    v1::UpdateInstrumentRequest request;
    request.mutable_instrument()->set_name(absl::StrCat("instruments/", id));
    request.mutable_instrument()->set_display_name(absl::StrCat(to));
    request.mutable_update_mask()->add_paths("display_name");
    grpc::ClientContext context;
    v1::Instrument reply;
    EXPECT_TRUE(Plant()->UpdateInstrument(&context, request, &reply).ok());
  }

  void AddInstrument(const std::string& id) {
    v1::CreateInstrumentRequest request;
    request.set_instrument_id(id);
    grpc::ClientContext context;
    v1::Instrument reply;
    const grpc::Status status = Plant()->CreateInstrument(&context, request, &reply);
    EXPECT_TRUE(status.ok()) << status.error_message();
  }

  std::unique_ptr<v1::PlantService::Stub> Plant() { return v1::PlantService::NewStub(Channel()); }

  // Reads until the follower has seen `resource` at `display_name`, or the stream ends.
  grpc::Status Follow(Follower& follower, const std::string& display_name) {
    v1::WatchRequest request;
    request.set_after_revision(follower.resume);
    request.set_epoch(follower.epoch);
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30));
    const auto stub = v1::WatchService::NewStub(Channel());
    const auto reader = stub->Watch(&context, request);
    v1::WatchResponse response;
    bool found = false;
    // Within a snapshot there is nothing to resume from yet.
    while (!(found && follower.resume > 0) && reader->Read(&response)) {
      follower.Take(response);
      for (const v1::WatchEvent& event : response.events())
        found = found || event.instrument().display_name() == display_name;
    }
    if (found) context.TryCancel();
    const grpc::Status status = reader->Finish();
    return found ? grpc::Status::OK : status;
  }
};

// Would catch a snapshot without what there is, a change that is not told, and one that is told
// twice.
TEST_F(WatchTest, SnapshotThenEachChangeOnce) {
  AddInstrument("a");
  AddInstrument("b");
  std::thread changes([this] {
    for (int i = 1; i <= 200; ++i) Rename("a", i);
  });
  Follower follower;
  EXPECT_TRUE(Follow(follower, "200").ok());
  changes.join();
  EXPECT_EQ(follower.revisions.count("instruments/b"), 1u);
}

// Would catch a gap or a repeat where a watch is resumed, also by another server over the same
// database.
TEST_F(WatchTest, ResumesWhereItEndedAlsoAfterARestart) {
  AddInstrument("a");
  Follower follower;
  Rename("a", 1);
  ASSERT_TRUE(Follow(follower, "1").ok());
  const int seen = follower.events;
  for (int i = 2; i <= 5; ++i) Rename("a", i);
  Restart();
  for (int i = 6; i <= 9; ++i) Rename("a", i);
  ASSERT_TRUE(Follow(follower, "9").ok());
  EXPECT_EQ(follower.events - seen, 8);
}

// Would catch a watch that waits for ever with revisions of another store.
TEST_F(WatchTest, RefusesWhatItsHistoryDoesNotHold) {
  AddInstrument("a");
  Follower follower;
  follower.resume = 1'000'000;
  follower.epoch = "0123";
  EXPECT_EQ(Follow(follower, "never").error_code(), grpc::StatusCode::OUT_OF_RANGE);
}

// Would catch a slow reader that is cut without what a program needs to go on without gap or
// repeat.
TEST_F(WatchTest, CutsASlowReaderWithTheRevisionToResumeFrom) {
  AddInstrument("a");
  Rename("a", 1);
  Follower follower;
  ASSERT_TRUE(Follow(follower, "1").ok());
  options_.watch_stall = absl::Nanoseconds(1);  // no reader is quicker
  Restart();
  Rename("a", 2);
  const grpc::Status cut = Follow(follower, "never");
  EXPECT_EQ(cut.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << cut.error_message();
  const ErrorMetadata metadata = ErrorMetadataOf(client::FromGrpcStatus(cut, options_.listen));
  ASSERT_EQ(metadata.count("resume_revision"), 1u);
  EXPECT_EQ(metadata.at("resume_revision"), absl::StrCat(follower.resume));
  options_.watch_stall = server::ServerOptions().watch_stall;
  Restart();
  Rename("a", 3);
  const int seen = follower.events;
  ASSERT_TRUE(Follow(follower, "3").ok());
  EXPECT_EQ(follower.events - seen, 1);
}

// Would catch progress that never comes, comes again and again without news, or is kept as history.
TEST_F(WatchTest, ProgressOfARunningJobComesBeside) {
  runner_.calibrate = [](const v1::CalibrationInput&, const jobs::RunnerHooks& hooks) {
    v1::JobProgress progress;
    progress.set_fraction(0.5);
    hooks.on_progress(progress);
    while (!hooks.is_cancelled()) absl::SleepFor(absl::Milliseconds(2));
    return absl::StatusOr<v1::Calibration>(absl::CancelledError("asked to end"));
  };
  Restart();
  testing::Import(NewClient(), "arm", testing::Uuid(1), testing::MeasuringSession(20, 1));
  ASSERT_THAT(NewClient().CreateCalibrationJob(
                  testing::JobRequest(testing::Uuid(1), "arm", testing::Uuid(1))),
              IsOk());
  const std::string job = absl::StrCat("jobs/", testing::Uuid(1));
  v1::WatchRequest request;
  request.set_progress(true);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30));
  const auto stub = v1::WatchService::NewStub(Channel());
  const auto reader = stub->Watch(&context, request);
  v1::WatchResponse response;
  int told = 0;
  for (bool ended = false; !ended && reader->Read(&response);) {
    for (const v1::WatchedProgress& one : response.progress()) {
      EXPECT_EQ(one.job(), job);
      EXPECT_EQ(one.progress().fraction(), 0.5);
      EXPECT_EQ(response.events_size(), 0);
      EXPECT_GT(response.revision(), 0) << "a watch may resume from here";
      ++told;
      v1::CancelCalibrationJobRequest cancel;
      cancel.set_name(job);
      EXPECT_THAT(NewClient().CancelCalibrationJob(cancel), IsOk());
    }
    for (const v1::WatchEvent& event : response.events())
      ended = ended || event.job().state() == v1::CANCELLED;
  }
  EXPECT_EQ(told, 1);
  context.TryCancel();
  reader->Finish();
}

}  // namespace
}  // namespace truepose
