// Answers to requests that carry an id, so that a repeat gets the first answer and has no second
// effect.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/store/transaction.h"

namespace truepose::store {

inline constexpr absl::Duration kKeepReplies = absl::Hours(7 * 24);

struct RequestKey {
  std::string principal;
  std::string method;
  std::string request_id;  // a UUID
  std::string digest;      // of the request's content
};

// The stored answer's bytes; nothing when the request is new.
// @returns kInvalidArgument for an id that is no UUID, or that came with another content before
// (field request_id).
absl::StatusOr<std::optional<std::string>> FindReply(Snapshot& snapshot, const RequestKey& key);

// In the transaction of the effect itself.
absl::Status KeepReply(Transaction& transaction, const RequestKey& key, std::string_view reply);

// Whether there are answers older than kKeepReplies: a look before a write.
absl::StatusOr<bool> HasRepliesToForget(Snapshot& snapshot, absl::Time now);

// Forgets at most `most` answers older than kKeepReplies. @returns how many.
absl::StatusOr<int64_t> ForgetReplies(Transaction& transaction, int64_t most);

}  // namespace truepose::store
