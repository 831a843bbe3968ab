// A request with an id has one effect and one answer: a repeat within 7 days, in parallel or after
// a restart, gets the stored answer.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "absl/status/statusor.h"
#include "core/base/status_macros.h"
#include "google/protobuf/message.h"
#include "server/store/replies.h"
#include "server/store/store.h"

namespace truepose::resource {

// Who asks, and for what: the digest is made of the request's bytes in deterministic form.
store::RequestKey KeyOf(const std::string& principal, const google::protobuf::Message& request,
                        const std::string& request_id);

// Runs `effect`, which fills `reply`, once for each id; a repeat fills it from what is stored. An
// error is not kept: the request may be tried again. "" as id runs it always. Call it within a
// Store::Write.
absl::Status OnceInto(store::Transaction& transaction, const store::RequestKey& key,
                      google::protobuf::Message& reply,
                      const std::function<absl::Status()>& effect);

// The same for a closure that returns StatusOr<Reply>.
template <typename Reply, typename Closure>
absl::StatusOr<Reply> Once(store::Transaction& transaction, const store::RequestKey& key,
                           Closure&& closure) {
  Reply reply;
  TRUEPOSE_RETURN_IF_ERROR(OnceInto(transaction, key, reply, [&]() -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(reply, closure(transaction));
    return absl::OkStatus();
  }));
  return reply;
}

}  // namespace truepose::resource
