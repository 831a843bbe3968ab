#include <optional>
#include <utility>

#include "core/base/status_macros.h"
#include "server/rpc/pull_stream.h"
#include "server/services/bindings/admission.h"
#include "server/services/bindings/binding.h"
#include "server/services/download.h"
#include "truepose/v1/download_services.grpc.pb.h"

namespace truepose::services {
namespace {

using watch::Wake;

class DownloadBinding final : public v1::DownloadService::CallbackService {
 public:
  DownloadBinding(const CallContext& call, const Executors& executors, rpc::Drain& drain,
                  const WatchSettings& settings)
      : call_(call),
        handlers_(executors.handlers),
        compute_(executors.compute),
        drain_(drain),
        settings_(settings) {}

  grpc::ServerWriteReactor<v1::DownloadResponse>* Download(
      grpc::CallbackServerContext* context, const v1::DownloadRequest* request) override {
    const auto stream =
        Stream::Make(context, rpc::MakeCall("Download", *context), handlers_, settings_.stall);
    drain_.Add(stream);
    static const auto access = auth::AccessTo("Download");
    const absl::StatusOr<CallContext> call = Admit(call_, access, *context);
    if (!call.ok()) {
      stream->End(call.status());
      return stream.get();
    }
    // It reads and digests the whole first. The request is copied: the stream may be finished, and
    // the request gone, before this runs.
    const bool accepted = compute_.Submit(
        [this, stream, call = *call, copy = *request] { Begin(stream, call, copy); });
    if (!accepted) stream->End(rpc::TooBusy());
    return stream.get();
  }

 private:
  using Stream = rpc::PullStream<v1::DownloadResponse>;

  // A reader that stalls is found by the hub's ticks.
  std::shared_ptr<void> Listen(const std::shared_ptr<Stream>& stream) const {
    return settings_.hub.Add([weak = std::weak_ptr<Stream>(stream)](Wake wake) {
      const std::shared_ptr<Stream> alive = weak.lock();
      if (alive != nullptr && wake == Wake::kTick) alive->CheckStall();
    });
  }

  void Begin(const std::shared_ptr<Stream>& stream, const CallContext& call,
             const v1::DownloadRequest& request) {
    auto begun = rpc::Guarded([&] { return services::Download::Begin(call, request); });
    if (!begun.ok()) return stream->End(begun.status());
    const std::shared_ptr<services::Download> download = *std::move(begun);
    const auto next = [call, download, weak = std::weak_ptr<Stream>(stream)]()
        -> absl::StatusOr<std::optional<v1::DownloadResponse>> {
      TRUEPOSE_RETURN_IF_ERROR(Recheck(call));
      auto chunk = download->Next();
      const std::shared_ptr<Stream> alive = weak.lock();
      if (chunk.ok() && !chunk->has_value() && alive != nullptr) alive->End(absl::OkStatus());
      return chunk;
    };
    const auto too_slow = [] {
      return absl::ResourceExhaustedError("the download was read too slowly; go on at the offset");
    };
    stream->Begin({.next = next, .too_slow = too_slow}, Listen(stream));
    stream->Wake();
  }

  const CallContext call_;
  rpc::Executor& handlers_;
  rpc::Executor& compute_;
  rpc::Drain& drain_;
  const WatchSettings settings_;
};

}  // namespace

std::unique_ptr<grpc::Service> BindDownloadService(const CallContext& call,
                                                   const Executors& executors, rpc::Drain& drain,
                                                   const WatchSettings& settings) {
  return std::make_unique<DownloadBinding>(call, executors, drain, settings);
}

}  // namespace truepose::services
