#include "server/resource/once.h"

#include "absl/strings/str_cat.h"
#include "server/store/checksum.h"
#include "server/store/message.h"

namespace truepose::resource {

store::RequestKey KeyOf(const std::string& principal, const google::protobuf::Message& request,
                        const std::string& request_id) {
  return {.principal = principal,
          .method = request.GetTypeName(),
          .request_id = request_id,
          .digest = request_id.empty() ? "" : store::Sha256Hex(store::ToBlob(request))};
}

absl::Status OnceInto(store::Transaction& transaction, const store::RequestKey& key,
                      google::protobuf::Message& reply,
                      const std::function<absl::Status()>& effect) {
  if (key.request_id.empty()) return effect();
  TRUEPOSE_ASSIGN_OR_RETURN(const auto stored, store::FindReply(transaction, key));
  if (stored.has_value() && reply.ParseFromString(*stored)) return absl::OkStatus();
  if (stored.has_value()) {
    return absl::DataLossError(absl::StrCat("a stored ", reply.GetTypeName(), " can't be read"));
  }
  TRUEPOSE_RETURN_IF_ERROR(effect());
  return store::KeepReply(transaction, key, reply.SerializeAsString());
}

}  // namespace truepose::resource
