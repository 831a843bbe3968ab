#include "server/server.h"

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "absl/time/clock.h"
#include "client/channel.h"
#include "client/client.h"
#include "grpcpp/client_context.h"
#include "grpcpp/impl/codegen/client_unary_call.h"
#include "tests/server/testing/examples.h"
#include "tests/server/testing/expect_status.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::server {
namespace {

using testing::HasCode;
using testing::IsOk;

absl::StatusOr<v1::Calibration> NoRunner(const v1::CalibrationInput&, const jobs::RunnerHooks&) {
  return absl::InternalError("no job runs here");
}

class ServerTest : public ::testing::Test {
 protected:
  ServerOptions Options() const {
    ServerOptions options;
    options.listen = absl::StrCat("unix:", folder_.File("s.sock"));
    options.database = folder_.File("t.db");
    options.dev_open = true;
    return options;
  }

  testing::TempDir folder_;
};

client::Client ClientOf(const Server& server) {
  auto client = client::Client::Connect(server.address());
  EXPECT_THAT(client, IsOk());
  return *std::move(client);
}

// grpc.health.v1.Health/Check by hand, since its messages are part of no package: the reply
// {status} is the bytes 08 NN.
int HealthOf(const Server& server) {
  const auto channel = client::MakeChannel(server.address());
  grpc::ClientContext context;
  const grpc::internal::RpcMethod method("/grpc.health.v1.Health/Check",
                                         grpc::internal::RpcMethod::NORMAL_RPC);
  const grpc::Slice nothing;
  const grpc::ByteBuffer request(&nothing, 1);
  grpc::ByteBuffer reply;
  const grpc::Status status = grpc::internal::BlockingUnaryCall<grpc::ByteBuffer, grpc::ByteBuffer>(
      channel.get(), method, &context, request, &reply);
  EXPECT_TRUE(status.ok()) << status.error_message();
  grpc::Slice slice;
  if (!reply.DumpToSingleSlice(&slice).ok() || slice.size() < 2) return 0;
  return slice.begin()[1];
}

// Would catch a server that takes calls without its services, or says nothing of its health.
TEST_F(ServerTest, ServesAtAUnixSocketAndIsHealthy) {
  const auto server = Server::Start(Options(), NoRunner);
  ASSERT_THAT(server, IsOk());
  EXPECT_EQ((*server)->address(), Options().listen);
  EXPECT_THAT(ClientOf(**server).CreateRobot(testing::RobotRequest("ur10")), IsOk());
  EXPECT_EQ(HealthOf(**server), 1);  // SERVING
}

// Would catch a server that asks nobody by default, and one whose health needs a token.
TEST_F(ServerTest, WithoutDevOpenTokensAreAskedForAndHealthIsOpen) {
  ServerOptions options = Options();
  options.dev_open = false;
  const auto server = Server::Start(options, NoRunner);
  ASSERT_THAT(server, IsOk());
  EXPECT_THAT(ClientOf(**server).ListRobots({}), HasCode(absl::StatusCode::kUnauthenticated));
  EXPECT_EQ(HealthOf(**server), 1);  // SERVING
  EXPECT_EQ((*server)->bootstrap_file(), options.database + ".bootstrap");
}

// Would catch a port that can't be left to the system, or is not told.
TEST_F(ServerTest, PortZeroTakesAFreePortAndTellsIt) {
  ServerOptions options = Options();
  options.listen = "127.0.0.1:0";
  const auto server = Server::Start(options, NoRunner);
  ASSERT_THAT(server, IsOk());
  EXPECT_NE((*server)->address(), "127.0.0.1:0");
  EXPECT_THAT(ClientOf(**server).ListRobots({}), IsOk());
}

// Would catch a second server that shares the address, and one that makes a database before it sees
// that.
TEST_F(ServerTest, AddressInUseIsUnavailableAndLeavesNoDatabase) {
  ServerOptions first = Options(), second = Options();
  first.listen = "127.0.0.1:0";
  const auto server = Server::Start(first, NoRunner);
  ASSERT_THAT(server, IsOk());
  second.listen = (*server)->address();
  second.database = folder_.File("second.db");
  EXPECT_THAT(Server::Start(second, NoRunner), HasCode(absl::StatusCode::kUnavailable));
  EXPECT_FALSE(std::filesystem::exists(second.database));
}

// Would catch two servers on one database.
TEST_F(ServerTest, ASecondServerOnOneDatabaseIsRefused) {
  const auto server = Server::Start(Options(), NoRunner);
  ASSERT_THAT(server, IsOk());
  ServerOptions second = Options();
  second.listen = "127.0.0.1:0";
  EXPECT_THAT(Server::Start(second, NoRunner), HasCode(absl::StatusCode::kFailedPrecondition));
}

// Would catch a server that overwrites what is no database of its own.
TEST_F(ServerTest, AFileThatIsNoDatabaseIsRefusedAndKept) {
  std::ofstream(Options().database) << "row,x_mm,y_mm\n" << std::string(5000, '1');
  EXPECT_THAT(Server::Start(Options(), NoRunner), HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_EQ(std::filesystem::file_size(Options().database), 5014u);
}

TEST_F(ServerTest, BadOptionsAreInvalid) {
  ServerOptions options = Options();
  options.workers = 0;
  EXPECT_THAT(Server::Start(options, NoRunner), HasCode(absl::StatusCode::kInvalidArgument));
}

// Would catch what was acknowledged and is gone after an ordered stop, or a stop that leaves the
// socket behind.
TEST_F(ServerTest, StoppedAndStartedAgainItHasEverything) {
  {
    const auto server = Server::Start(Options(), NoRunner);
    ASSERT_THAT(server, IsOk());
    ASSERT_THAT(ClientOf(**server).CreateRobot(testing::RobotRequest("ur10")), IsOk());
    (*server)->Stop();
    (*server)->Stop();
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.File("s.sock")));
  const auto server = Server::Start(Options(), NoRunner);
  ASSERT_THAT(server, IsOk());
  v1::GetRobotRequest request;
  request.set_name("robots/ur10");
  EXPECT_THAT(ClientOf(**server).GetRobot(request), IsOk());
}

// Runs until it is asked to end, as a long calibration does.
class EndlessRunner {
 public:
  jobs::Runner runner() {
    return [this](const v1::CalibrationInput&,
                  const jobs::RunnerHooks& hooks) -> absl::StatusOr<v1::Calibration> {
      ++begun_;
      while (!hooks.is_cancelled()) absl::SleepFor(absl::Milliseconds(2));
      return absl::CancelledError("asked to end");
    };
  }
  int begun() const { return begun_; }

 private:
  std::atomic<int> begun_{0};
};

void StartJob(const client::Client& client) {
  ASSERT_THAT(client.CreateRobot(testing::RobotRequest("ur10")), IsOk());
  ASSERT_THAT(client.CreateSession(testing::SessionRequest(testing::kSession1, "robots/ur10")),
              IsOk());
  const auto stream = client.OpenAppendStream();
  ASSERT_TRUE(stream->Write(testing::Batch(testing::kSession1, 0, 5)));
  stream->WritesDone();
  v1::AppendReadingsResponse acknowledgement;
  ASSERT_TRUE(stream->Read(&acknowledgement));
  ASSERT_FALSE(stream->Read(&acknowledgement));
  ASSERT_THAT(stream->Finish(), IsOk());
  v1::SealSessionRequest seal;
  seal.set_name(absl::StrCat("sessions/", testing::kSession1));
  seal.set_reading_count(5);
  ASSERT_THAT(client.SealSession(seal), IsOk());
  v1::CreateCalibrationJobRequest job;
  job.set_job_id(testing::kJob1);
  job.set_robot("robots/ur10");
  job.add_sessions(seal.name());
  ASSERT_THAT(client.CreateCalibrationJob(job), IsOk());
}

// Would catch a stop that waits for a watch or an idle upload until the deadline cuts it, or a
// watcher that takes the end of the server for the end of the job.
TEST_F(ServerTest, StopEndsStreamsAtOnceWithUnavailable) {
  ServerOptions options = Options();
  options.drain = absl::Seconds(60);
  EndlessRunner endless;
  auto server = Server::Start(options, endless.runner());
  ASSERT_THAT(server, IsOk());
  const client::Client client = ClientOf(**server);
  ASSERT_NO_FATAL_FAILURE(StartJob(client));
  absl::Notification watching;
  absl::Status watch_end;
  std::thread watcher([&] {
    watch_end = client.WatchCalibrationJob(absl::StrCat("jobs/", testing::kJob1),
                                           [&](const v1::CalibrationJob&) {
                                             if (!watching.HasBeenNotified()) watching.Notify();
                                             return true;
                                           });
  });
  const auto idle = client.OpenAppendStream();
  ASSERT_TRUE(idle->Write(testing::Batch(testing::kSession1, 0, 1)));
  v1::AppendReadingsResponse acknowledgement;
  ASSERT_TRUE(idle->Read(&acknowledgement));
  ASSERT_TRUE(watching.WaitForNotificationWithTimeout(absl::Seconds(20)));
  const absl::Time begin = absl::Now();
  (*server)->Stop();
  EXPECT_LT(absl::Now() - begin, absl::Seconds(30)) << "waited for the drain's deadline";
  watcher.join();
  EXPECT_THAT(watch_end, HasCode(absl::StatusCode::kUnavailable));
  EXPECT_FALSE(idle->Read(&acknowledgement));
  EXPECT_THAT(idle->Finish(), HasCode(absl::StatusCode::kUnavailable));
}

// Would catch a job that is lost, or called failed, because its server was stopped.
TEST_F(ServerTest, AStoppedServersJobIsTakenUpByTheNext) {
  EndlessRunner endless;
  {
    const auto server = Server::Start(Options(), endless.runner());
    ASSERT_THAT(server, IsOk());
    ASSERT_NO_FATAL_FAILURE(StartJob(ClientOf(**server)));
    while (endless.begun() == 0) absl::SleepFor(absl::Milliseconds(2));
  }
  EndlessRunner next;
  const auto server = Server::Start(Options(), next.runner());
  ASSERT_THAT(server, IsOk());
  while (next.begun() == 0) absl::SleepFor(absl::Milliseconds(2));
  v1::GetCalibrationJobRequest request;
  request.set_name(absl::StrCat("jobs/", testing::kJob1));
  const auto job = ClientOf(**server).GetCalibrationJob(request);
  ASSERT_THAT(job, IsOk());
  EXPECT_EQ(job->state(), v1::RUNNING);
}

}  // namespace
}  // namespace truepose::server
