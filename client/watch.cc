#include "client/watch.h"

#include <thread>

namespace truepose::client {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPause{200};

// One follower over its connections.
class Follower {
 public:
  Follower(v1::WatchRequest request, const FollowOptions& options)
      : request_(std::move(request)), options_(options) {}

  // One connection. @returns why it ended; OK when the caller wants no more.
  absl::Status Connect(const Client& client,
                       const std::function<bool(const v1::WatchResponse&)>& on_response) {
    return client.Watch(
        request_,
        [&](const v1::WatchResponse& response) {
          heard_ = Clock::now();
          answered_ = true;
          if (response.revision() > 0) {
            request_.set_after_revision(response.revision());
            request_.set_epoch(response.epoch());
          }
          return on_response(response);
        },
        options_.is_cancelled);
  }

  // Whether another connection may help; sets where that begins.
  bool MayGoOn(const absl::Status& why) {
    switch (why.code()) {
      case absl::StatusCode::kUnavailable:
        return answered_ && Clock::now() - heard_ < options_.patience;
      case absl::StatusCode::kResourceExhausted:
        return true;
      // The server ends so who takes nothing for long; the caller's own wish is asked for first.
      case absl::StatusCode::kCancelled:
        return answered_;
      case absl::StatusCode::kOutOfRange:
        request_.clear_after_revision();
        request_.clear_epoch();
        return answered_;
      default:
        return false;
    }
  }

 private:
  v1::WatchRequest request_;
  const FollowOptions& options_;
  Clock::time_point heard_ = Clock::now();
  bool answered_ = false;
};

}  // namespace

absl::Status FollowWatch(const Client& client, v1::WatchRequest request,
                         const std::function<bool(const v1::WatchResponse&)>& on_response,
                         const FollowOptions& options) {
  Follower follower(std::move(request), options);
  while (true) {
    const absl::Status status = follower.Connect(client, on_response);
    if (status.ok() || !follower.MayGoOn(status)) return status;
    if (options.is_cancelled && options.is_cancelled()) {
      return absl::CancelledError("the watch was ended by its caller");
    }
    if (options.on_reconnect) options.on_reconnect(status);
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace truepose::client
