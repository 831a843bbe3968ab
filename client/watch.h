// The watch of a plant becomes one stream, however often the connection breaks or the server starts
// again.
#pragma once

#include <chrono>
#include <functional>

#include "absl/status/status.h"
#include "client/client.h"
#include "truepose/v1/watch.pb.h"

namespace truepose::client {

struct FollowOptions {
  // Asked a few times a second; true ends it with kCancelled.
  std::function<bool()> is_cancelled = {};
  // Before each further connection, with the reason why the last one ended.
  std::function<void(const absl::Status&)> on_reconnect = {};
  // How long the server may stay away. Counted anew from each response; who never answered is told
  // at once.
  std::chrono::milliseconds patience{60'000};
};

// Hands each response to `on_response` in this thread until that returns false: then OK. After a
// broken connection, or a cut because this reader was too slow, it resumes behind the last complete
// revision, so no change is missed or comes twice. A snapshot that broke off begins again; where
// the server's history doesn't reach back (or the store is another one) a new snapshot follows,
// which on_reconnect is told with kOutOfRange, unless the first request was refused so.
// @returns kCancelled; kUnavailable when no server answered for `patience`; else what the server
//   refuses the request with.
absl::Status FollowWatch(const Client& client, v1::WatchRequest request,
                         const std::function<bool(const v1::WatchResponse&)>& on_response,
                         const FollowOptions& options = {});

}  // namespace truepose::client
