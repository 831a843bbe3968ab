#include "server/services/bindings/admission.h"

#include "core/base/status_macros.h"
#include "server/rpc/call.h"
#include "server/services/administration.h"

namespace truepose::services {

absl::StatusOr<CallContext> Admit(const CallContext& call,
                                  const std::optional<auth::Access>& access,
                                  const grpc::CallbackServerContext& context) {
  if (call.administration == nullptr) return absl::InternalError("a server without administration");
  auth::Authenticator& authenticator = call.administration->authenticator;
  CallContext admitted = call;
  if (access == auth::Access::kEverybody && !authenticator.is_open_to_all()) {
    admitted.caller = {.principal = "", .is_admin = false, .is_local_dev = false};
    return admitted;
  }
  TRUEPOSE_ASSIGN_OR_RETURN(admitted.caller,
                            authenticator.Authenticate(rpc::MetadataOf(context, "authorization")));
  TRUEPOSE_RETURN_IF_ERROR(auth::CheckAccess(access, admitted.caller));
  return admitted;
}

absl::Status Recheck(const CallContext& admitted) {
  return admitted.administration->authenticator.Recheck(admitted.caller);
}

}  // namespace truepose::services
