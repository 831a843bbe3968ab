// What a field of a message is for files and people; for the .cc files of this folder.
#pragma once

#include <string>

#include "formats/unit.h"
#include "google/protobuf/descriptor.h"

namespace truepose::formats {

// A number's name without its unit, and what it measures: `position_sd_m` is {"position_sd",
// kLength}; kNone for what is no length or angle.
struct FieldMeasure {
  std::string stem;
  Dimension dimension = Dimension::kNone;
};
FieldMeasure MeasureOf(const google::protobuf::FieldDescriptor& field);

// A time or a duration: written as one text.
bool IsTime(const google::protobuf::FieldDescriptor& field);
bool IsDuration(const google::protobuf::FieldDescriptor& field);
// A message whose fields stand for themselves: no list, time or duration.
bool IsGroup(const google::protobuf::FieldDescriptor& field);

}  // namespace truepose::formats
