#include "client/cli/reply.h"

#include "client/cli/json.h"
#include "core/base/status_macros.h"

namespace truepose::cli {

absl::Status Reply(const Invocation& invocation, const google::protobuf::Message& message,
                   const std::function<std::string()>& text) {
  if (!invocation.json) {
    invocation.console.out << text();
    return absl::OkStatus();
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string json, ToJson(message));
  invocation.console.out << json << "\n";
  return absl::OkStatus();
}

}  // namespace truepose::cli
