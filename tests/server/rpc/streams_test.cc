// The stream adapters through real calls, where gRPC's own order of events counts.
#include <atomic>
#include <thread>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "absl/time/clock.h"
#include "grpcpp/create_channel.h"
#include "grpcpp/security/credentials.h"
#include "grpcpp/server.h"
#include "grpcpp/server_builder.h"
#include "gtest/gtest.h"
#include "server/rpc/ack_stream.h"
#include "server/rpc/latest_stream.h"
#include "truepose/v1/services.grpc.pb.h"

namespace truepose::rpc {
namespace {

using JobStream = LatestStream<v1::CalibrationJob>;
using Uploads = AckStream<v1::AppendReadingsRequest, v1::AppendReadingsResponse>;

// Hands the stream of the next call to the test.
class WatchService : public v1::CalibrationService::CallbackService {
 public:
  grpc::ServerWriteReactor<v1::CalibrationJob>* WatchCalibrationJob(
      grpc::CallbackServerContext* context, const v1::WatchCalibrationJobRequest*) override {
    const auto stream = JobStream::Make(MakeCall("Watch", *context));
    stream_ = stream;
    begun_.Notify();  // the test may take stream_ before this returns
    return stream.get();
  }
  // Waits for the call; the caller shares the stream from then on.
  std::shared_ptr<JobStream> Take() {
    begun_.WaitForNotification();
    return std::move(stream_);
  }

 private:
  absl::Notification begun_;
  std::shared_ptr<JobStream> stream_;
};

class UploadService : public v1::SessionService::CallbackService {
 public:
  UploadService(Executor& executor, Uploads::Function handler)
      : executor_(executor), handler_(std::move(handler)) {}
  grpc::ServerBidiReactor<v1::AppendReadingsRequest, v1::AppendReadingsResponse>* AppendReadings(
      grpc::CallbackServerContext* context) override {
    return Uploads::Make(executor_, MakeCall("Append", *context), handler_).get();
  }

 private:
  Executor& executor_;
  const Uploads::Function handler_;
};

// A server on a loopback port; channels within the process have no buffers and would hide how
// streams pile up.
class LoopbackServer {
 public:
  explicit LoopbackServer(grpc::Service& service) {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(&service);
    server_ = builder.BuildAndStart();
  }
  ~LoopbackServer() { server_->Shutdown(absl::ToChronoTime(absl::Now() + absl::Seconds(5))); }
  std::shared_ptr<grpc::Channel> channel() const {
    return grpc::CreateChannel(absl::StrCat("127.0.0.1:", port_),
                               grpc::InsecureChannelCredentials());
  }

 private:
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

v1::CalibrationJob JobNumber(int number) {
  v1::CalibrationJob job;
  job.set_attempts(number);
  job.set_robot(std::string(2000, 'r'));
  return job;
}

// A client's side of a watch.
struct Watch {
  explicit Watch(const LoopbackServer& server)
      : stub(v1::CalibrationService::NewStub(server.channel())),
        reader(stub->WatchCalibrationJob(&context, v1::WatchCalibrationJobRequest())) {}
  std::unique_ptr<v1::CalibrationService::Stub> stub;
  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReader<v1::CalibrationJob>> reader;
};

// Would catch a watcher that stalls and makes the server queue without end, or one that misses the
// last state.
TEST(LatestStreamTest, ASlowReaderSkipsButGetsTheLast) {
  constexpr int kLast = 20'000;
  WatchService service;
  const LoopbackServer server(service);
  Watch watch(server);
  const auto stream = service.Take();
  for (int i = 1; i <= kLast; ++i) stream->Push(JobNumber(i));
  stream->End(absl::OkStatus());
  stream->Push(JobNumber(kLast + 1));
  v1::CalibrationJob job;
  int read = 0, last = 0;
  while (watch.reader->Read(&job)) {
    EXPECT_GT(job.attempts(), last);
    last = job.attempts();
    ++read;
  }
  EXPECT_TRUE(watch.reader->Finish().ok());
  EXPECT_EQ(last, kLast);
  EXPECT_LT(read, kLast);
}

// Would catch a stream that outlives its client, and with it what it holds.
TEST(LatestStreamTest, AClientThatLeavesFreesTheStreamAndItsSource) {
  WatchService service;
  const LoopbackServer server(service);
  Watch watch(server);
  auto stream = service.Take();
  auto source = std::make_shared<int>(1);
  const std::weak_ptr<int> held = source;
  stream->Hold(std::move(source));
  EXPECT_FALSE(held.expired());
  watch.context.TryCancel();
  EXPECT_EQ(watch.reader->Finish().error_code(), grpc::StatusCode::CANCELLED);
  for (int i = 0; i < 2000 && !held.expired(); ++i) absl::SleepFor(absl::Milliseconds(5));
  EXPECT_TRUE(held.expired());
  stream->Push(JobNumber(1));  // too late, and harmless
  auto late = std::make_shared<int>(2);
  const std::weak_ptr<int> dropped = late;
  stream->Hold(std::move(late));
  EXPECT_TRUE(dropped.expired()) << "a source that comes after the end is kept for ever";
}

// Would catch a status that is lost behind the last message, or sent twice.
TEST(LatestStreamTest, EndsOnceWithItsStatus) {
  WatchService service;
  const LoopbackServer server(service);
  Watch watch(server);
  const auto stream = service.Take();
  stream->Push(JobNumber(1));
  std::vector<std::thread> enders;
  for (int i = 0; i < 8; ++i)
    enders.emplace_back([&] { stream->End(absl::NotFoundError("gone")); });
  for (std::thread& ender : enders) ender.join();
  v1::CalibrationJob job;
  EXPECT_TRUE(watch.reader->Read(&job));
  EXPECT_FALSE(watch.reader->Read(&job));
  EXPECT_EQ(watch.reader->Finish().error_code(), grpc::StatusCode::NOT_FOUND);
}

// A client's side of an upload.
struct Upload {
  explicit Upload(const LoopbackServer& server)
      : stub(v1::SessionService::NewStub(server.channel())),
        stream(stub->AppendReadings(&context)) {}
  void Write(const std::string& session) {
    v1::AppendReadingsRequest request;
    request.set_session(session);
    stream->Write(request);
  }
  std::unique_ptr<v1::SessionService::Stub> stub;
  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReaderWriter<v1::AppendReadingsRequest, v1::AppendReadingsResponse>>
      stream;
};

// Would catch answers that are mixed up, or a request that is handled before the one ahead was
// answered.
TEST(AckStreamTest, AnswersEachRequestInOrder) {
  std::atomic<int> inside{0}, handled{0};
  Executor executor(4, 100);
  UploadService service(
      executor,
      [&](const v1::AppendReadingsRequest&) -> absl::StatusOr<v1::AppendReadingsResponse> {
        EXPECT_EQ(++inside, 1);
        v1::AppendReadingsResponse response;
        response.set_reading_count(++handled);
        --inside;
        return response;
      });
  const LoopbackServer server(service);
  Upload upload(server);
  for (int i = 0; i < 100; ++i) upload.Write("s");
  upload.stream->WritesDone();
  v1::AppendReadingsResponse response;
  for (int i = 1; i <= 100; ++i) {
    ASSERT_TRUE(upload.stream->Read(&response));
    EXPECT_EQ(response.reading_count(), i);
  }
  EXPECT_FALSE(upload.stream->Read(&response));
  EXPECT_TRUE(upload.stream->Finish().ok());
}

// Answers four requests at once, the last of them first, in gRPC's own thread.
class Reverser : public Uploads::Handler {
 public:
  bool IsQuick(const v1::AppendReadingsRequest&) const override { return true; }
  void Begin(const v1::AppendReadingsRequest& request, Done done) override {
    waiting_.emplace_back(request.first_sequence(), std::move(done));
    if (waiting_.size() < 4) return;
    for (auto one = waiting_.rbegin(); one != waiting_.rend(); ++one) {
      v1::AppendReadingsResponse response;
      response.set_durable_sequence(one->first);
      one->second(response);
    }
    waiting_.clear();
  }

 private:
  std::vector<std::pair<int64_t, Done>> waiting_;
};

class ReversingService : public v1::SessionService::CallbackService {
 public:
  explicit ReversingService(Executor& executor) : executor_(executor) {}
  grpc::ServerBidiReactor<v1::AppendReadingsRequest, v1::AppendReadingsResponse>* AppendReadings(
      grpc::CallbackServerContext* context) override {
    return Uploads::Make(executor_, MakeCall("Append", *context), std::make_unique<Reverser>())
        .get();
  }

 private:
  Executor& executor_;
};

// Would catch acknowledgements that overtake one another, or a stream that waits for an answer
// before it reads on: then the fourth request never came.
TEST(AckStreamTest, LateAnswersLeaveInTheOrderOfTheRequests) {
  Executor executor(1, 1);
  ReversingService service(executor);
  const LoopbackServer server(service);
  Upload upload(server);
  v1::AppendReadingsRequest request;
  for (int i = 1; i <= 40; ++i) {
    request.set_first_sequence(i);
    upload.stream->Write(request);
  }
  upload.stream->WritesDone();
  v1::AppendReadingsResponse response;
  for (int i = 1; i <= 40; ++i) {
    ASSERT_TRUE(upload.stream->Read(&response));
    EXPECT_EQ(response.durable_sequence(), i);
  }
  EXPECT_FALSE(upload.stream->Read(&response));
  EXPECT_TRUE(upload.stream->Finish().ok());
}

// Would catch a request that is handled although the one ahead failed.
TEST(AckStreamTest, EndsAtTheFirstThatFails) {
  std::atomic<int> handled{0};
  Executor executor(1, 100);
  UploadService service(
      executor,
      [&](const v1::AppendReadingsRequest& request) -> absl::StatusOr<v1::AppendReadingsResponse> {
        ++handled;
        if (request.session() == "bad") return absl::AbortedError("another content");
        return v1::AppendReadingsResponse();
      });
  const LoopbackServer server(service);
  Upload upload(server);
  for (const char* session : {"good", "bad", "good", "good"}) upload.Write(session);
  v1::AppendReadingsResponse response;
  EXPECT_TRUE(upload.stream->Read(&response));
  EXPECT_FALSE(upload.stream->Read(&response));
  EXPECT_EQ(upload.stream->Finish().error_code(), grpc::StatusCode::ABORTED);
  EXPECT_EQ(handled, 2);
}

// Would catch an upload that hangs for ever when the server has no thread for it.
TEST(AckStreamTest, ATooBusyServerSaysSo) {
  Executor executor(1, 1);
  absl::Notification started, go;
  ASSERT_TRUE(executor.Submit([&] {
    started.Notify();
    go.WaitForNotification();
  }));
  started.WaitForNotification();
  ASSERT_TRUE(executor.Submit([] {}));
  UploadService service(
      executor, [](const v1::AppendReadingsRequest&) -> absl::StatusOr<v1::AppendReadingsResponse> {
        return v1::AppendReadingsResponse();
      });
  {
    const LoopbackServer server(service);
    Upload upload(server);
    upload.Write("s");
    v1::AppendReadingsResponse response;
    EXPECT_FALSE(upload.stream->Read(&response));
    EXPECT_EQ(upload.stream->Finish().error_code(), grpc::StatusCode::UNAVAILABLE);
  }
  go.Notify();
}

}  // namespace
}  // namespace truepose::rpc
