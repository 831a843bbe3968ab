// The calls of Client that are streams.
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

#include "client/client.h"
#include "client/client_impl.h"
#include "client/status.h"

namespace truepose::client {
namespace {

using grpc::ClientContext;

// Asks `is_cancelled` beside a blocking read and cancels the call, which ends the read.
class CancelWatcher {
 public:
  CancelWatcher(ClientContext& context, const std::function<bool()>& is_cancelled) {
    if (!is_cancelled) return;
    thread_ = std::thread([this, &context, is_cancelled] {
      while (!done_ && !cancelled_) {
        if (is_cancelled()) {
          cancelled_ = true;
          context.TryCancel();
        } else {
          std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
      }
    });
  }
  ~CancelWatcher() { Join(); }

  // No more questions; whether the answer was ever yes.
  bool Join() {
    done_ = true;
    if (thread_.joinable()) thread_.join();
    return cancelled_;
  }

 private:
  std::atomic<bool> done_{false}, cancelled_{false};
  std::thread thread_;
};

// Reads to the end of the stream, or until `on_message` wants no more, which is OK.
template <typename Message>
absl::Status ReadAll(ClientContext& context, grpc::ClientReader<Message>& stream,
                     const std::function<bool(const Message&)>& on_message,
                     const std::function<bool()>& is_cancelled, const std::string& address) {
  CancelWatcher watcher(context, is_cancelled);
  Message message;
  bool wanted = true;
  while (wanted && stream.Read(&message)) wanted = on_message(message);
  const bool cancelled = watcher.Join();
  if (!wanted) context.TryCancel();
  const grpc::Status status = stream.Finish();
  if (!wanted) return absl::OkStatus();
  if (cancelled) return absl::CancelledError("the watch was ended by its caller");
  return FromGrpcStatus(status, address);
}

class GrpcAppendStream : public AppendStream {
 public:
  GrpcAppendStream(v1::SessionService::Stub& stub, std::string address,
                   const ClientOptions& options)
      : address_(std::move(address)) {
    PrepareContext(context_, options);
    stream_ = stub.AppendReadings(&context_);
  }
  // A stream that was not finished is given up; the server keeps what it acknowledged.
  ~GrpcAppendStream() override {
    if (finished_) return;
    context_.TryCancel();
    stream_->Finish();
  }

  bool Write(const v1::AppendReadingsRequest& batch) override { return stream_->Write(batch); }
  void WritesDone() override { stream_->WritesDone(); }
  bool Read(v1::AppendReadingsResponse* acknowledgement) override {
    return stream_->Read(acknowledgement);
  }
  absl::Status Finish() override {
    finished_ = true;
    return FromGrpcStatus(stream_->Finish(), address_);
  }

 private:
  const std::string address_;
  ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::AppendReadingsRequest, v1::AppendReadingsResponse>>
      stream_;
  bool finished_ = false;
};

}  // namespace

absl::Status Client::WatchCalibrationJob(
    const std::string& name, const std::function<bool(const v1::CalibrationJob&)>& on_job,
    const std::function<bool()>& is_cancelled) const {
  ClientContext context;
  PrepareContext(context, impl_->options);
  v1::WatchCalibrationJobRequest request;
  request.set_name(name);
  const auto stream = impl_->calibrations->WatchCalibrationJob(&context, request);
  return ReadAll(context, *stream, on_job, is_cancelled, impl_->address);
}

absl::Status Client::Watch(const v1::WatchRequest& request,
                           const std::function<bool(const v1::WatchResponse&)>& on_response,
                           const std::function<bool()>& is_cancelled) const {
  ClientContext context;
  PrepareContext(context, impl_->options);
  const auto stream = impl_->watches->Watch(&context, request);
  return ReadAll(context, *stream, on_response, is_cancelled, impl_->address);
}

absl::Status Client::ReadDownload(
    const v1::DownloadRequest& request,
    const std::function<bool(const v1::DownloadResponse&)>& on_chunk) const {
  ClientContext context;
  PrepareContext(context, impl_->options);
  const auto stream = impl_->downloads->Download(&context, request);
  return ReadAll(context, *stream, on_chunk, {}, impl_->address);
}

std::unique_ptr<AppendStream> Client::OpenAppendStream() const {
  return std::make_unique<GrpcAppendStream>(*impl_->sessions, impl_->address, impl_->options);
}

}  // namespace truepose::client
