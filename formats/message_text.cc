#include "formats/message_text.h"

#include <algorithm>

#include "formats/message_field.h"
#include "formats/number.h"
#include "formats/strings.h"
#include "formats/yaml_map.h"
#include "google/protobuf/duration.pb.h"
#include "google/protobuf/timestamp.pb.h"
#include "google/protobuf/util/time_util.h"

namespace truepose::formats {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::util::TimeUtil;

std::string KeyForPeople(const FieldDescriptor& field) {
  const FieldMeasure measure = MeasureOf(field);
  if (measure.dimension == Dimension::kNone) return field.name();
  return NamesWithUnits(measure.stem, measure.dimension).front();
}

void AddKeys(const Descriptor& descriptor, const std::string& path,
             const std::vector<std::string>& left_out, std::vector<std::string>& keys) {
  for (int i = 0; i < descriptor.field_count(); ++i) {
    const FieldDescriptor& field = *descriptor.field(i);
    const bool out = std::find(left_out.begin(), left_out.end(), field.name()) != left_out.end();
    if (out || field.is_repeated()) continue;
    const std::string key = FieldPath(path, KeyForPeople(field));
    if (IsGroup(field)) {
      AddKeys(*field.message_type(), key, {}, keys);
    } else {
      keys.push_back(key);
    }
  }
}

std::string TimeText(const Message& value) {
  if (const auto* time = dynamic_cast<const google::protobuf::Timestamp*>(&value)) {
    return TimeUtil::ToString(TimeUtil::SecondsToTimestamp(time->seconds()));
  }
  return TimeUtil::ToString(static_cast<const google::protobuf::Duration&>(value));
}

std::string NumberText(const Message& message, const FieldDescriptor& field) {
  const auto* reflection = message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return FormatNumber(reflection->GetDouble(message, &field));
    case FieldDescriptor::CPPTYPE_INT32:
      return StrCat(reflection->GetInt32(message, &field));
    case FieldDescriptor::CPPTYPE_INT64:
      return StrCat(reflection->GetInt64(message, &field));
    case FieldDescriptor::CPPTYPE_UINT64:
      return StrCat(reflection->GetUInt64(message, &field));
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection->GetBool(message, &field) ? "true" : "false";
    case FieldDescriptor::CPPTYPE_ENUM:
      return reflection->GetEnum(message, &field)->name();
    default:
      return reflection->GetString(message, &field);
  }
}

FieldText Describe(const Message& message, const FieldDescriptor& field, const std::string& path) {
  const auto* reflection = message.GetReflection();
  const FieldMeasure measure = MeasureOf(field);
  const std::string key = FieldPath(path, field.name());
  if (field.is_repeated()) return {key, StrCat(reflection->FieldSize(message, &field))};
  if (field.message_type() != nullptr)
    return {key, TimeText(reflection->GetMessage(message, &field))};
  if (measure.dimension == Dimension::kNone) return {key, NumberText(message, field)};
  const Measure shown = MeasureForPeople(reflection->GetDouble(message, &field), measure.dimension);
  return {FieldPath(path, StrCat(measure.stem, "_", shown.symbol)), shown.digits};
}

void DescribeInto(const Message& message, const std::string& path, std::vector<FieldText>& texts) {
  std::vector<const FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    if (IsGroup(*field)) {
      DescribeInto(message.GetReflection()->GetMessage(message, field),
                   FieldPath(path, field->name()), texts);
    } else {
      texts.push_back(Describe(message, *field, path));
    }
  }
}

}  // namespace

std::vector<std::string> SettableKeys(const Descriptor& descriptor,
                                      const std::vector<std::string>& left_out) {
  std::vector<std::string> keys;
  AddKeys(descriptor, "", left_out, keys);
  return keys;
}

std::vector<FieldText> DescribeMessage(const Message& message) {
  std::vector<FieldText> texts;
  DescribeInto(message, "", texts);
  return texts;
}

}  // namespace truepose::formats
