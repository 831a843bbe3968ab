#include "tests/integration/recorder.h"

#include <utility>

#include "absl/time/clock.h"
#include "grpcpp/client_context.h"
#include "gtest/gtest.h"
#include "tests/integration/effects.h"
#include "truepose/v1/watch_services.grpc.pb.h"

namespace truepose::testing {
namespace {

// One client over all of its watches.
class Recorder {
 public:
  Recorder(const std::string& address, WatchPosition begin, std::string last, const Habits& habits)
      : stub_(v1::WatchService::NewStub(ImpatientChannel(address))),
        position_(std::move(begin)),
        last_(std::move(last)),
        habits_(habits) {}

  // One watch. @returns whether the end has come.
  bool Follow() {
    v1::WatchRequest request;
    request.set_epoch(position_.epoch);
    request.set_after_revision(position_.revision);
    grpc::ClientContext context;
    context.set_wait_for_ready(true);
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30));
    const auto reader = stub_->Watch(&context, request);
    v1::WatchResponse response;
    for (int messages = 0; !ended_ && reader->Read(&response);) {
      Take(response);
      if (habits_.pause > absl::ZeroDuration()) absl::SleepFor(habits_.pause);
      if (++messages == habits_.hang_up_after) break;
    }
    context.TryCancel();
    const grpc::Status status = reader->Finish();
    EXPECT_NE(status.error_code(), grpc::StatusCode::OUT_OF_RANGE) << status.error_message();
    EXPECT_NE(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << status.error_message();
    return ended_;
  }

  std::vector<Heard> TakeHeard() { return std::move(heard_); }

 private:
  void Take(const v1::WatchResponse& response) {
    EXPECT_EQ(response.epoch(), position_.epoch);
    EXPECT_GE(response.revision(), position_.revision) << "a response steps back";
    EXPECT_FALSE(response.snapshot());
    position_.revision = response.revision();
    for (const v1::WatchEvent& event : response.events()) {
      heard_.push_back({event.revision(), event.name()});
      ended_ = ended_ || event.name() == last_;
    }
  }

  const std::unique_ptr<v1::WatchService::Stub> stub_;
  WatchPosition position_;
  const std::string last_;
  const Habits habits_;
  std::vector<Heard> heard_;
  bool ended_ = false;
};

}  // namespace

WatchPosition PositionNow(const std::string& address) {
  const auto stub = v1::WatchService::NewStub(ImpatientChannel(address));
  grpc::ClientContext context;
  const auto reader = stub->Watch(&context, {});
  v1::WatchResponse response;
  while (reader->Read(&response) && !response.snapshot_complete()) {
  }
  context.TryCancel();
  reader->Finish();
  EXPECT_TRUE(response.snapshot_complete());
  return {response.epoch(), response.revision()};
}

std::vector<Heard> Record(const std::string& address, WatchPosition begin, const std::string& last,
                          const Habits& habits) {
  Recorder recorder(address, std::move(begin), last, habits);
  const absl::Time give_up = absl::Now() + absl::Minutes(5);
  while (!recorder.Follow()) {
    if (absl::Now() > give_up || ::testing::Test::HasFailure()) {
      ADD_FAILURE() << last << " never came";
      break;
    }
  }
  return recorder.TakeHeard();
}

}  // namespace truepose::testing
