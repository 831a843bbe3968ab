#include "server/resource/standard_fields.h"

#include "absl/strings/str_cat.h"
#include "google/protobuf/timestamp.pb.h"
#include "google/protobuf/util/field_comparator.h"
#include "google/protobuf/util/message_differencer.h"
#include "server/store/checksum.h"
#include "server/store/message.h"

namespace truepose::resource {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Timestamp;

const FieldDescriptor* Find(const Message& message, const std::string& field) {
  return message.GetDescriptor()->FindFieldByName(field);
}

bool IsOfServer(const ResourceType& type, const FieldDescriptor* field) {
  // An agent's own `version` is text; ours counts.
  if (field->name() == "version") return field->cpp_type() == FieldDescriptor::CPPTYPE_INT32;
  if (IsStandardField(field->name())) return true;
  for (const std::string& name : type.output_only) {
    if (name == field->name()) return true;
  }
  return false;
}

void SetText(Message& message, const char* field, const std::string& value) {
  message.GetReflection()->SetString(&message, Find(message, field), value);
}

void SetTime(const store::Transaction& transaction, const char* field, Message& message) {
  message.GetReflection()
      ->MutableMessage(&message, Find(message, field))
      ->CopyFrom(store::ToTimestamp(transaction.now()));
}

const FieldDescriptor* VersionField(const Message& message) {
  const FieldDescriptor* field = Find(message, "version");
  const bool counts = field != nullptr && field->cpp_type() == FieldDescriptor::CPPTYPE_INT32;
  return counts ? field : nullptr;
}

bool DiffersIn(const std::string& name, const Message& a, const Message& b) {
  google::protobuf::util::MessageDifferencer differencer;
  return !differencer.CompareWithFields(a, b, {Find(a, name)}, {Find(b, name)});
}

}  // namespace

std::string GetText(const Message& message, const char* field) {
  return message.GetReflection()->GetString(message, Find(message, field));
}

bool IsDeleted(const Message& resource) {
  return resource.GetReflection()->HasField(resource, Find(resource, "delete_time"));
}

void ClearServerFields(const ResourceType& type, Message& resource) {
  const auto* descriptor = resource.GetDescriptor();
  for (int i = 0; i < descriptor->field_count(); ++i) {
    if (IsOfServer(type, descriptor->field(i)))
      resource.GetReflection()->ClearField(&resource, descriptor->field(i));
  }
}

void CopyServerFields(const ResourceType& type, const Message& stored, Message& resource) {
  ClearServerFields(type, resource);
  std::unique_ptr<Message> fields(stored.New());
  fields->CopyFrom(stored);
  const auto* descriptor = stored.GetDescriptor();
  for (int i = 0; i < descriptor->field_count(); ++i) {
    if (!IsOfServer(type, descriptor->field(i)))
      fields->GetReflection()->ClearField(fields.get(), descriptor->field(i));
  }
  resource.MergeFrom(*fields);
}

void PrepareContent(const ResourceType& type, const std::string& principal, Message& content) {
  ClearServerFields(type, content);
  if (Find(content, "created_by") != nullptr) SetText(content, "created_by", principal);
}

void StampNew(const store::Transaction& transaction, const std::string& name, Message& resource) {
  SetText(resource, "name", name);
  SetText(resource, "uid", store::NewUuid());
  SetTime(transaction, "create_time", resource);
  if (const FieldDescriptor* version = VersionField(resource)) {
    resource.GetReflection()->SetInt32(&resource, version, 1);
  }
  Restamp(transaction, resource);
}

void Restamp(const store::Transaction& transaction, Message& resource) {
  SetTime(transaction, "update_time", resource);
  resource.GetReflection()->SetInt64(&resource, Find(resource, "revision"), transaction.revision());
  SetText(resource, "etag", store::ToEtag(transaction.revision()));
}

void SetDeleted(const store::Transaction& transaction, bool deleted, Message& resource) {
  if (deleted) return SetTime(transaction, "delete_time", resource);
  resource.GetReflection()->ClearField(&resource, Find(resource, "delete_time"));
}

void RaiseVersion(const ResourceType& type, const Message& stored, Message& resource) {
  const FieldDescriptor* version = VersionField(resource);
  if (version == nullptr) return;
  for (const std::string& name : type.versioned) {
    if (!DiffersIn(name, stored, resource)) continue;
    const int now = stored.GetReflection()->GetInt32(stored, version) + 1;
    return resource.GetReflection()->SetInt32(&resource, version, now);
  }
}

}  // namespace truepose::resource
