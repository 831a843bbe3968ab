// Reading a request of a standard method by the names of its fields; an absent field reads as "", 0
// or false.
#pragma once

#include <string>

#include "google/protobuf/field_mask.pb.h"
#include "google/protobuf/message.h"
#include "server/resource/resource_type.h"

namespace truepose::services {

std::string TextOf(const google::protobuf::Message& request, const std::string& field);
int NumberOf(const google::protobuf::Message& request, const std::string& field);
bool FlagOf(const google::protobuf::Message& request, const std::string& field);
google::protobuf::FieldMask MaskOf(const google::protobuf::Message& request);

// The resource that a create or update carries, and the name of its field.
struct Carried {
  const resource::ResourceType* type = nullptr;  // nullptr: it carries none
  const google::protobuf::Message* content = nullptr;
  std::string field;
};
Carried CarriedBy(const google::protobuf::Message& request);

// The repeated field of a list's response that takes the items.
const google::protobuf::FieldDescriptor* ItemsOf(const google::protobuf::Message& response);

}  // namespace truepose::services
