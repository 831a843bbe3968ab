#include "server/services/request_fields.h"

#include "server/resource/registry.h"

namespace truepose::services {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

const FieldDescriptor* Find(const Message& request, const std::string& field) {
  return request.GetDescriptor()->FindFieldByName(field);
}

}  // namespace

std::string TextOf(const Message& request, const std::string& field) {
  const FieldDescriptor* found = Find(request, field);
  return found == nullptr ? "" : request.GetReflection()->GetString(request, found);
}

int NumberOf(const Message& request, const std::string& field) {
  const FieldDescriptor* found = Find(request, field);
  return found == nullptr ? 0 : request.GetReflection()->GetInt32(request, found);
}

bool FlagOf(const Message& request, const std::string& field) {
  const FieldDescriptor* found = Find(request, field);
  return found != nullptr && request.GetReflection()->GetBool(request, found);
}

google::protobuf::FieldMask MaskOf(const Message& request) {
  const FieldDescriptor* found = Find(request, "update_mask");
  if (found == nullptr) return {};
  return static_cast<const google::protobuf::FieldMask&>(
      request.GetReflection()->GetMessage(request, found));
}

Carried CarriedBy(const Message& request) {
  const auto* descriptor = request.GetDescriptor();
  for (int i = 0; i < descriptor->field_count(); ++i) {
    const FieldDescriptor* field = descriptor->field(i);
    if (field->message_type() == nullptr) continue;
    const resource::ResourceType* type = resource::FindType(field->message_type());
    if (type != nullptr)
      return {type, &request.GetReflection()->GetMessage(request, field), field->name()};
  }
  return {};
}

const FieldDescriptor* ItemsOf(const Message& response) {
  const auto* descriptor = response.GetDescriptor();
  for (int i = 0; i < descriptor->field_count(); ++i) {
    if (descriptor->field(i)->is_repeated()) return descriptor->field(i);
  }
  return nullptr;
}

}  // namespace truepose::services
