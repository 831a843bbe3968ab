#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/error_metadata.h"
#include "core/base/fault.h"
#include "server/rpc/pull_stream.h"
#include "server/services/bindings/binding.h"
#include "server/store/message.h"
#include "server/watch/plant_watch.h"
#include "truepose/v1/watch_services.grpc.pb.h"

namespace truepose::services {
namespace {

using watch::PlantWatch;
using watch::Wake;

// A watcher and when it last heard something.
struct Watcher {
  std::unique_ptr<PlantWatch> watch;
  absl::Duration idle;
  absl::Time last = absl::Now();

  absl::StatusOr<std::optional<v1::WatchResponse>> Next() {
    absl::StatusOr<std::optional<v1::WatchResponse>> next = watch->Next();
    if (next.ok() && !next->has_value() && absl::Now() - last >= idle) next = watch->Bookmark();
    if (next.ok() && next->has_value()) last = absl::Now();
    return next;
  }

  absl::Status TooSlow() const {
    const std::string revision = absl::StrCat(watch->resume_revision());
    return WithErrorMetadata(
        store::Refusal(absl::StatusCode::kResourceExhausted, "after_revision",
                       "a reader that is too slow",
                       absl::StrCat("a watch that resumes from revision ", revision)),
        "resume_revision", revision);
  }
};

class WatchBinding final : public v1::WatchService::CallbackService {
 public:
  WatchBinding(const CallContext& call, const Executors& executors, rpc::Drain& drain,
               const WatchSettings& settings)
      : call_(call), handlers_(executors.handlers), drain_(drain), settings_(settings) {}

  grpc::ServerWriteReactor<v1::WatchResponse>* Watch(grpc::CallbackServerContext* context,
                                                     const v1::WatchRequest* request) override {
    const auto stream =
        Stream::Make(context, rpc::MakeCall("Watch", *context), handlers_, settings_.stall);
    drain_.Add(stream);
    // The request is copied: the stream may be finished, and the request gone, before this runs.
    const bool accepted =
        handlers_.Submit([this, stream, copy = *request] { Begin(stream, copy); });
    if (!accepted) stream->End(rpc::TooBusy());
    return stream.get();
  }

 private:
  using Stream = rpc::PullStream<v1::WatchResponse>;

  void Begin(const std::shared_ptr<Stream>& stream, const v1::WatchRequest& request) {
    auto begun = rpc::Guarded([&] { return PlantWatch::Begin(call_.store, request); });
    if (!begun.ok()) return stream->End(begun.status());
    auto watcher = std::make_shared<Watcher>(*std::move(begun), settings_.idle);
    std::shared_ptr<void> listening =
        settings_.hub.Add([weak = std::weak_ptr<Stream>(stream)](Wake wake) {
          const std::shared_ptr<Stream> alive = weak.lock();
          if (alive == nullptr) return;
          if (wake == Wake::kTick) alive->CheckStall();
          alive->Wake();
        });
    stream->Begin({.next = [watcher] { return watcher->Next(); },
                   .too_slow = [watcher] { return watcher->TooSlow(); }},
                  std::move(listening));
    stream->Wake();
  }

  const CallContext call_;
  rpc::Executor& handlers_;
  rpc::Drain& drain_;
  const WatchSettings settings_;
};

}  // namespace

std::unique_ptr<grpc::Service> BindWatchService(const CallContext& call, const Executors& executors,
                                                rpc::Drain& drain, const WatchSettings& settings) {
  return std::make_unique<WatchBinding>(call, executors, drain, settings);
}

}  // namespace truepose::services
