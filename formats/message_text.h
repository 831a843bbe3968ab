// Messages of the API in the keys and units that people read and message_file.h takes.
#pragma once

#include <string>
#include <vector>

#include "google/protobuf/message.h"

namespace truepose::formats {

// The keys that can be given one by one: "serial", "position_sd_mm", "pose.x_mm"; lists can't.
// @param left_out names of fields at the top that don't count.
std::vector<std::string> SettableKeys(const google::protobuf::Descriptor& descriptor,
                                      const std::vector<std::string>& left_out);

// A field's key and value in units for people.
struct FieldText {
  std::string key;   // "position_sd_mm"
  std::string text;  // "0.02"
};
// Every field that is set, in the order of its numbers; nested ones by their paths ("pose.x_mm");
// of a list the number of its items; times without fractions of a second.
std::vector<FieldText> DescribeMessage(const google::protobuf::Message& message);

}  // namespace truepose::formats
