// What the handlers of AdminService need beside the store: the tokens that are known, and the facts
// of this server that no store has.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

#include "absl/time/time.h"
#include "server/auth/authenticator.h"
#include "server/auth/bootstrap.h"

namespace truepose::services {

struct ServerFacts {
  std::string version;
  absl::Time start;
  std::string time_zone;                    // IANA name of the plant's
  std::function<int64_t()> database_bytes;  // the files together
  std::function<int64_t()> watchers;        // streams of WatchService
};

// One of a server; all its functions are safe from any thread.
struct Administration {
  auth::Authenticator& authenticator;
  auth::Bootstrap& bootstrap;
  const ServerFacts facts;
  // One new secret after the other, so that what the authenticator learns last is what the store
  // has.
  std::mutex new_secret = {};
};

}  // namespace truepose::services
