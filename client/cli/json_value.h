// JSON of what no message describes: values put together by hand.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "google/protobuf/struct.pb.h"

namespace truepose::cli {

inline google::protobuf::Value Number(double number) {
  google::protobuf::Value value;
  value.set_number_value(number);
  return value;
}

// @param text UTF-8.
inline google::protobuf::Value Text(const std::string& text) {
  google::protobuf::Value value;
  value.set_string_value(text);
  return value;
}

inline google::protobuf::Value Object(google::protobuf::Struct object) {
  google::protobuf::Value value;
  *value.mutable_struct_value() = std::move(object);
  return value;
}

// A list of what `convert` makes of each item.
template <typename Items, typename Convert>
google::protobuf::Value List(const Items& items, Convert convert) {
  google::protobuf::Value value;
  google::protobuf::ListValue* list = value.mutable_list_value();
  for (const auto& item : items) *list->add_values() = convert(item);
  return value;
}

inline google::protobuf::Struct StructOf(
    std::vector<std::pair<std::string, google::protobuf::Value>> fields) {
  google::protobuf::Struct object;
  for (auto& [name, value] : fields) (*object.mutable_fields())[name] = std::move(value);
  return object;
}

}  // namespace truepose::cli
