// The standard methods of every kind that server/resource/registry.h knows, read off the request's
// own fields: parent, {kind}_id, {kind}, name, etag, update_mask, request_id, validate_only,
// page_size, page_token, filter, show_deleted.
#pragma once

#include "absl/status/status.h"
#include "google/protobuf/message.h"
#include "server/services/call_context.h"

namespace truepose::services {

// Each fills `response`: the resource, or the list's response. Errors are those of
// server/resource/standard_methods.h and once.h.
absl::Status CreateStandard(const CallContext& call, const google::protobuf::Message& request,
                            google::protobuf::Message& response);
absl::Status GetStandard(const CallContext& call, const google::protobuf::Message& request,
                         google::protobuf::Message& response);
absl::Status ListStandard(const CallContext& call, const google::protobuf::Message& request,
                          google::protobuf::Message& response);
absl::Status UpdateStandard(const CallContext& call, const google::protobuf::Message& request,
                            google::protobuf::Message& response);
absl::Status DeleteStandard(const CallContext& call, const google::protobuf::Message& request,
                            google::protobuf::Message& response);
absl::Status UndeleteStandard(const CallContext& call, const google::protobuf::Message& request,
                              google::protobuf::Message& response);

}  // namespace truepose::services
