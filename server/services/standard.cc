#include "server/services/standard.h"

#include <memory>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/resource/once.h"
#include "server/resource/registry.h"
#include "server/resource/resource_name.h"
#include "server/resource/standard_fields.h"
#include "server/resource/standard_methods.h"
#include "server/services/closures.h"
#include "server/services/request_fields.h"

namespace truepose::services {
namespace {

using google::protobuf::Message;
using store::Snapshot;
using store::Transaction;

absl::Status NoSuchKind(const Message& message) {
  return absl::InternalError(absl::StrCat(message.GetTypeName(), " carries no known resource"));
}

// Fills `reply` once for each request id, and stores nothing with validate_only.
template <typename Effect>
absl::Status Mutate(const CallContext& call, const Message& request, Message& reply,
                    Effect effect) {
  const store::RequestKey key =
      resource::KeyOf(call.caller.principal, request, TextOf(request, "request_id"));
  const auto closure = [&](Transaction& transaction) -> absl::StatusOr<bool> {
    reply.Clear();
    TRUEPOSE_RETURN_IF_ERROR(
        resource::OnceInto(transaction, key, reply, [&] { return effect(transaction); }));
    return true;
  };
  return WriteUnless(FlagOf(request, "validate_only"), call.store, closure).status();
}

}  // namespace

absl::Status CreateStandard(const CallContext& call, const Message& request, Message& response) {
  const Carried carried = CarriedBy(request);
  if (carried.type == nullptr) return NoSuchKind(request);
  const std::string id_field = carried.field + "_id";
  TRUEPOSE_ASSIGN_OR_RETURN(const store::ResourceKey key,
                            resource::MakeKey(*carried.type, TextOf(request, "parent"),
                                              TextOf(request, id_field), id_field));
  const std::unique_ptr<Message> content(carried.content->New());
  content->CopyFrom(*carried.content);
  resource::PrepareContent(*carried.type, call.caller.principal, *content);
  return Mutate(call, request, response, [&](Transaction& transaction) {
    return resource::Create(transaction, *carried.type, key, *content, carried.field, response);
  });
}

absl::Status GetStandard(const CallContext& call, const Message& request, Message& response) {
  const resource::ResourceType* type = resource::FindType(response.GetDescriptor());
  if (type == nullptr) return NoSuchKind(response);
  return call.store.Read([&](Snapshot& snapshot) {
    response.Clear();
    return resource::Get(snapshot, *type, TextOf(request, "name"), "name", response);
  });
}

absl::Status ListStandard(const CallContext& call, const Message& request, Message& response) {
  const auto* items = ItemsOf(response);
  const resource::ResourceType* type =
      items == nullptr ? nullptr : resource::FindType(items->message_type());
  if (type == nullptr) return NoSuchKind(response);
  const resource::ListAsked asked{
      .parent = TextOf(request, "parent"),
      .page = {NumberOf(request, "page_size"), TextOf(request, "page_token")},
      .filter = TextOf(request, "filter"),
      .show_deleted = FlagOf(request, "show_deleted")};
  const auto* reflection = response.GetReflection();
  return call.store.Read([&](Snapshot& snapshot) -> absl::Status {
    response.Clear();
    TRUEPOSE_ASSIGN_OR_RETURN(const std::string token, resource::List(snapshot, *type, asked, [&] {
                                return reflection->AddMessage(&response, items);
                              }));
    const auto* next = response.GetDescriptor()->FindFieldByName("next_page_token");
    reflection->SetString(&response, next, token);
    return absl::OkStatus();
  });
}

absl::Status UpdateStandard(const CallContext& call, const Message& request, Message& response) {
  const Carried carried = CarriedBy(request);
  if (carried.type == nullptr) return NoSuchKind(request);
  return Mutate(call, request, response, [&](Transaction& transaction) {
    return resource::Update(transaction, *carried.type, *carried.content, MaskOf(request),
                            carried.field, response);
  });
}

absl::Status DeleteStandard(const CallContext& call, const Message& request, Message& response) {
  const resource::ResourceType* type = resource::FindType(response.GetDescriptor());
  if (type == nullptr) return NoSuchKind(response);
  return Mutate(call, request, response, [&](Transaction& transaction) {
    return resource::Delete(transaction, *type, TextOf(request, "name"), TextOf(request, "etag"),
                            response);
  });
}

absl::Status UndeleteStandard(const CallContext& call, const Message& request, Message& response) {
  const resource::ResourceType* type = resource::FindType(response.GetDescriptor());
  if (type == nullptr) return NoSuchKind(response);
  return Mutate(call, request, response, [&](Transaction& transaction) {
    return resource::Undelete(transaction, *type, TextOf(request, "name"), response);
  });
}

}  // namespace truepose::services
