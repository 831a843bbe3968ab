#include "client/wait_for_job.h"

#include <atomic>
#include <mutex>
#include <thread>

#include "gmock/gmock.h"
#include "tests/client/fake_server.h"
#include "truepose/v1/services.grpc.pb.h"

namespace truepose::client {
namespace {

v1::CalibrationJob Job(v1::JobState state) {
  v1::CalibrationJob job;
  job.set_name("jobs/j");
  job.set_state(state);
  return job;
}

// A stream of the script: what it tells, then how it ends.
struct Told {
  std::vector<v1::JobState> states = {};
  grpc::Status end = grpc::Status::OK;
  bool hangs = false;  // until the client leaves
};

class FakeJobs : public v1::CalibrationService::Service {
 public:
  std::vector<Told> script;  // the last is repeated
  std::atomic<int> streams{0}, looks{0};

  grpc::Status WatchCalibrationJob(grpc::ServerContext* context,
                                   const v1::WatchCalibrationJobRequest*,
                                   grpc::ServerWriter<v1::CalibrationJob>* writer) override {
    const size_t number = streams++;
    const Told& told = script[std::min(number, script.size() - 1)];
    for (const v1::JobState state : told.states) writer->Write(Job(state));
    while (told.hangs && !context->IsCancelled())
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return told.end;
  }

  grpc::Status GetCalibrationJob(grpc::ServerContext*, const v1::GetCalibrationJobRequest*,
                                 v1::CalibrationJob* reply) override {
    *reply = Job(++looks < 3 ? v1::RUNNING : v1::SUCCEEDED);
    return grpc::Status::OK;
  }
};

const grpc::Status kBroken(grpc::StatusCode::UNAVAILABLE, "broken");

class WaitForJobTest : public ::testing::Test {
 protected:
  absl::StatusOr<v1::CalibrationJob> Wait() { return WaitForJob(client_, "jobs/j", options_); }

  FakeJobs fake_;
  testing::FakeServer server_{fake_};
  Client client_ = server_.MakeClient();
  WaitOptions options_{.patience = std::chrono::seconds(20),
                       .poll_interval = std::chrono::milliseconds(10)};
};

// Would catch a wait that ends early or hides a change from the progress bar.
TEST_F(WaitForJobTest, ReturnsTheTerminalJobAndTellsEachChange) {
  fake_.script = {{.states = {v1::PENDING, v1::RUNNING, v1::RUNNING, v1::FAILED}}};
  std::vector<v1::JobState> told;
  options_.on_change = [&](const v1::CalibrationJob& job) { told.push_back(job.state()); };
  const auto job = Wait();
  ASSERT_TRUE(job.ok()) << job.status();
  EXPECT_EQ(job->state(), v1::FAILED);
  EXPECT_EQ(told, fake_.script[0].states);
}

// Would catch a wait that is lost with the connection, as when the server is started again.
TEST_F(WaitForJobTest, ConnectsAgainWhenTheStreamBreaks) {
  fake_.script = {
      {{v1::RUNNING}, kBroken}, {{}, kBroken}, {.states = {v1::RUNNING, v1::SUCCEEDED}}};
  const auto job = Wait();
  ASSERT_TRUE(job.ok()) << job.status();
  EXPECT_EQ(job->state(), v1::SUCCEEDED);
  EXPECT_EQ(fake_.streams, 3);
}

// Would catch a stream that ends well before the job does and is taken for its end.
TEST_F(WaitForJobTest, AnEarlyEndIsNotTheJobs) {
  fake_.script = {{.states = {v1::RUNNING}}, {.states = {v1::CANCELLED}}};
  const auto job = Wait();
  ASSERT_TRUE(job.ok()) << job.status();
  EXPECT_EQ(job->state(), v1::CANCELLED);
}

// Would catch a wait that needs streams where a proxy passes none.
TEST_F(WaitForJobTest, AsksWhereStreamsDoNotPass) {
  fake_.script = {{{}, grpc::Status(grpc::StatusCode::UNIMPLEMENTED, "no streams here")}};
  const auto job = Wait();
  ASSERT_TRUE(job.ok()) << job.status();
  EXPECT_EQ(job->state(), v1::SUCCEEDED);
  EXPECT_EQ(fake_.streams, 1);
  EXPECT_EQ(fake_.looks, 3);
}

// Would catch a wait for a job that does not exist.
TEST_F(WaitForJobTest, AnUnknownJobIsNotWaitedFor) {
  fake_.script = {{{}, grpc::Status(grpc::StatusCode::NOT_FOUND, "jobs/j")}};
  EXPECT_TRUE(absl::IsNotFound(Wait().status()));
  EXPECT_EQ(fake_.streams, 1);
}

TEST_F(WaitForJobTest, GivesUpWhenPatienceEnds) {
  fake_.script = {{{}, kBroken}};
  options_.patience = std::chrono::milliseconds(300);
  EXPECT_TRUE(absl::IsUnavailable(Wait().status()));
  EXPECT_GE(fake_.streams, 2);
}

// Would catch a person who presses Ctrl-C and has to wait for the server to say something.
TEST_F(WaitForJobTest, TheCallerMayLeaveWhileNothingComes) {
  fake_.script = {{.states = {v1::RUNNING}, .end = {}, .hangs = true}};
  std::atomic<bool> told{false};
  options_.on_change = [&](const v1::CalibrationJob&) { told = true; };
  options_.is_cancelled = [&] { return told.load(); };
  EXPECT_TRUE(absl::IsCancelled(Wait().status()));
  EXPECT_EQ(fake_.streams, 1);
}

}  // namespace
}  // namespace truepose::client
