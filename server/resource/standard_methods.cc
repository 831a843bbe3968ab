#include "server/resource/standard_methods.h"

#include <optional>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "google/protobuf/util/message_differencer.h"
#include "server/resource/etag.h"
#include "server/resource/field_mask.h"
#include "server/resource/filter.h"
#include "server/resource/resource_name.h"
#include "server/resource/standard_fields.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/robots.h"

namespace truepose::resource {
namespace {

using google::protobuf::Message;
using google::protobuf::util::MessageDifferencer;

absl::Status Parse(const std::string& bytes, Message& resource) {
  if (resource.ParseFromString(bytes)) return absl::OkStatus();
  return absl::DataLossError(absl::StrCat("a stored ", resource.GetTypeName(), " can't be read"));
}

absl::Status CheckContent(const ResourceType& type, const Message& content,
                          const std::string& field) {
  FaultList inner, faults;
  type.check(content, inner);
  if (inner.empty()) return absl::OkStatus();
  faults.AddAll(inner.ToStatus(), absl::StrCat(field, "."));
  return faults.ToStatus();
}

absl::Status CheckWithin(store::Transaction& transaction, const ResourceType& type,
                         const store::ResourceKey& key, const Message& content,
                         const std::string& field) {
  if (type.check_within == nullptr) return absl::OkStatus();
  FaultList inner, faults;
  TRUEPOSE_RETURN_IF_ERROR(type.check_within(transaction, key, content, inner));
  if (inner.empty()) return absl::OkStatus();
  faults.AddAll(inner.ToStatus(), absl::StrCat(field, "."));
  return faults.ToStatus();
}

absl::Status CheckParent(store::Snapshot& snapshot, const store::ResourceKey& key) {
  if (key.robot_id.empty()) return absl::OkStatus();
  const absl::Status found = store::GetRobot(snapshot, store::RobotName(key.robot_id)).status();
  if (!absl::IsNotFound(found)) return found;
  return store::NotFound(store::RobotName(key.robot_id), "parent");
}

absl::Status Put(store::Transaction& transaction, const ResourceType& type,
                 const Message& resource) {
  const std::string name = GetText(resource, "name");
  TRUEPOSE_ASSIGN_OR_RETURN(const store::ResourceKey key, ParseName(type, name, "name"));
  const bool open = type.is_open != nullptr && type.is_open(resource);
  return store::PutResource(transaction, key, name, resource, IsDeleted(resource), open);
}

bool HasSameContent(const ResourceType& type, const Message& stored, const Message& content) {
  const std::unique_ptr<Message> a(stored.New()), b(stored.New());
  a->CopyFrom(stored);
  b->CopyFrom(content);
  ClearServerFields(type, *a);
  ClearServerFields(type, *b);
  return MessageDifferencer::Equals(*a, *b);
}

absl::Status Known(const ResourceType& type, const std::string& bytes, const Message& content,
                   Message& resource) {
  TRUEPOSE_RETURN_IF_ERROR(Parse(bytes, resource));
  const bool deleted = IsDeleted(resource);
  if (!deleted && HasSameContent(type, resource, content)) return absl::OkStatus();
  return store::Refusal(absl::StatusCode::kAlreadyExists, "id", GetText(resource, "name"),
                        deleted ? "an id that is free, or undelete" : "a new id, or an update");
}

// The stored state of one that is there and not deleted.
absl::Status GetLive(store::Snapshot& snapshot, const ResourceType& type, const std::string& name,
                     const std::string& field, Message& resource) {
  TRUEPOSE_RETURN_IF_ERROR(Get(snapshot, type, name, field, resource));
  return IsDeleted(resource) ? store::NotFound(name, field) : absl::OkStatus();
}

}  // namespace

absl::Status Create(store::Transaction& transaction, const ResourceType& type,
                    const store::ResourceKey& key, const Message& content, const std::string& field,
                    Message& resource) {
  TRUEPOSE_RETURN_IF_ERROR(CheckContent(type, content, field));
  TRUEPOSE_RETURN_IF_ERROR(CheckParent(transaction, key));
  TRUEPOSE_ASSIGN_OR_RETURN(const auto stored, store::FindResource(transaction, key));
  if (stored.has_value()) return Known(type, *stored, content, resource);
  TRUEPOSE_RETURN_IF_ERROR(CheckWithin(transaction, type, key, content, field));
  resource.CopyFrom(content);
  StampNew(transaction, ToName(type, key), resource);
  return Put(transaction, type, resource);
}

absl::Status Get(store::Snapshot& snapshot, const ResourceType& type, const std::string& name,
                 const std::string& field, Message& resource) {
  TRUEPOSE_ASSIGN_OR_RETURN(const store::ResourceKey key, ParseName(type, name, field));
  TRUEPOSE_ASSIGN_OR_RETURN(const auto stored, store::FindResource(snapshot, key));
  return stored.has_value() ? Parse(*stored, resource) : store::NotFound(name, field);
}

absl::Status Update(store::Transaction& transaction, const ResourceType& type,
                    const Message& changes, const google::protobuf::FieldMask& mask,
                    const std::string& field, Message& resource) {
  const std::string name_field = absl::StrCat(field, ".name");
  TRUEPOSE_RETURN_IF_ERROR(
      GetLive(transaction, type, GetText(changes, "name"), name_field, resource));
  TRUEPOSE_RETURN_IF_ERROR(CheckEtag(GetText(resource, "etag"), GetText(changes, "etag")));
  const std::unique_ptr<Message> before(resource.New());
  before->CopyFrom(resource);
  TRUEPOSE_RETURN_IF_ERROR(ApplyUpdate(changes, mask, type.output_only, resource));
  TRUEPOSE_RETURN_IF_ERROR(CheckContent(type, resource, field));
  if (MessageDifferencer::Equals(*before, resource)) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const store::ResourceKey key,
                            ParseName(type, GetText(resource, "name"), name_field));
  TRUEPOSE_RETURN_IF_ERROR(CheckWithin(transaction, type, key, resource, field));
  RaiseVersion(type, *before, resource);
  return Replace(transaction, type, resource);
}

absl::Status Replace(store::Transaction& transaction, const ResourceType& type, Message& resource) {
  Restamp(transaction, resource);
  return Put(transaction, type, resource);
}

absl::Status Delete(store::Transaction& transaction, const ResourceType& type,
                    const std::string& name, const std::string& etag, Message& resource) {
  TRUEPOSE_RETURN_IF_ERROR(Get(transaction, type, name, "name", resource));
  TRUEPOSE_RETURN_IF_ERROR(CheckEtag(GetText(resource, "etag"), etag));
  if (IsDeleted(resource)) return absl::OkStatus();
  SetDeleted(transaction, true, resource);
  return Replace(transaction, type, resource);
}

absl::Status Undelete(store::Transaction& transaction, const ResourceType& type,
                      const std::string& name, Message& resource) {
  TRUEPOSE_RETURN_IF_ERROR(Get(transaction, type, name, "name", resource));
  if (!IsDeleted(resource)) return absl::OkStatus();
  SetDeleted(transaction, false, resource);
  return Replace(transaction, type, resource);
}

absl::StatusOr<std::string> List(store::Snapshot& snapshot, const ResourceType& type,
                                 const ListAsked& asked, const std::function<Message*()>& add) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Predicate belongs,
                            ParseFilter(asked.filter, type.prototype->GetDescriptor()));
  store::ResourceList list{.kind = type.kind,
                           .robot_id = std::nullopt,
                           .show_deleted = asked.show_deleted,
                           .filter = asked.filter,
                           .only_open = asked.only_open};
  if (type.kind == v1::KIND_COMPENSATION_TABLE)
    list.sha256 = TextAskedFor(asked.filter, "sha256").value_or("");
  if (!asked.parent.empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(list.robot_id, store::ParseRobotName(asked.parent, "parent"));
    TRUEPOSE_RETURN_IF_ERROR(
        CheckParent(snapshot, {.kind = type.kind, .robot_id = *list.robot_id, .id = ""}));
  }
  const std::unique_ptr<Message> item(type.prototype->New());
  return store::ListResources(snapshot, list, asked.page,
                              [&](const std::string& bytes) -> absl::StatusOr<bool> {
                                TRUEPOSE_RETURN_IF_ERROR(Parse(bytes, *item));
                                if (!belongs(*item)) return false;
                                add()->CopyFrom(*item);
                                return true;
                              });
}

}  // namespace truepose::resource
