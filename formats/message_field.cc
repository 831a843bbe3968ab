#include "formats/message_field.h"

#include <string_view>

#include "formats/strings.h"
#include "google/protobuf/duration.pb.h"
#include "google/protobuf/timestamp.pb.h"

namespace truepose::formats {

using google::protobuf::FieldDescriptor;

FieldMeasure MeasureOf(const FieldDescriptor& field) {
  std::string_view stem = field.name();
  if (field.cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE) return {};
  if (ConsumeSuffix(&stem, "_m")) return {std::string(stem), Dimension::kLength};
  if (ConsumeSuffix(&stem, "_rad")) return {std::string(stem), Dimension::kAngle};
  return {};
}

bool IsTime(const FieldDescriptor& field) {
  return field.message_type() == google::protobuf::Timestamp::descriptor();
}

bool IsDuration(const FieldDescriptor& field) {
  return field.message_type() == google::protobuf::Duration::descriptor();
}

bool IsGroup(const FieldDescriptor& field) {
  return field.message_type() != nullptr && !field.is_repeated() && !IsTime(field) &&
         !IsDuration(field);
}

}  // namespace truepose::formats
