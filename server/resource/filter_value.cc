#include "server/resource/filter_value.h"

#include <cmath>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/time/time.h"
#include "core/base/status_macros.h"
#include "google/protobuf/timestamp.pb.h"

namespace truepose::resource {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Timestamp;

template <typename T>
int Order(const T& a, const T& b) {
  return a < b ? -1 : (b < a ? 1 : 0);
}

absl::Status BadValue(const FilterToken& value, const std::string& expected) {
  return FilterFault(value.column, absl::StrCat("'", value.text, "'"), expected);
}

// Each part between the stars in its order, the first and last at the ends.
bool MatchesPattern(const std::string& text, const std::vector<std::string>& parts) {
  if (!absl::StartsWith(text, parts.front())) return false;
  size_t at = parts.front().size();
  for (size_t i = 1; i + 1 < parts.size(); ++i) {
    const size_t found = text.find(parts[i], at);
    if (found == std::string::npos) return false;
    at = found + parts[i].size();
  }
  return text.size() >= at + parts.back().size() && absl::EndsWith(text, parts.back());
}

absl::StatusOr<Compare> CompareText(const FieldDescriptor* field, const FilterToken& value,
                                    const std::string& operation) {
  const std::vector<std::string> parts = absl::StrSplit(value.text, '*');
  if (parts.size() > 1 && operation != "=" && operation != "!=")
    return BadValue(value, "a text without *, or the operator = or !=");
  return Compare([field, parts](const Message& message) -> std::optional<int> {
    const std::string text = message.GetReflection()->GetString(message, field);
    if (parts.size() == 1) return Order(text, parts.front());
    return MatchesPattern(text, parts) ? std::optional(0) : std::nullopt;
  });
}

double NumberOf(const Message& message, const FieldDescriptor* field) {
  const auto* reflection = message.GetReflection();
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return reflection->GetInt32(message, field);
    case FieldDescriptor::CPPTYPE_INT64:
      return static_cast<double>(reflection->GetInt64(message, field));
    default:
      return reflection->GetDouble(message, field);
  }
}

absl::StatusOr<Compare> CompareNumber(const FieldDescriptor* field, const FilterToken& value) {
  double number = 0.0;
  if (!absl::SimpleAtod(value.text, &number) || std::isnan(number))
    return BadValue(value, "a number");
  return Compare([field, number](const Message& message) -> std::optional<int> {
    return Order(NumberOf(message, field), number);
  });
}

absl::StatusOr<Compare> CompareBool(const FieldDescriptor* field, const FilterToken& value) {
  if (value.text != "true" && value.text != "false") return BadValue(value, "true or false");
  const bool wanted = value.text == "true";
  return Compare([field, wanted](const Message& message) -> std::optional<int> {
    return Order(message.GetReflection()->GetBool(message, field), wanted);
  });
}

std::string NamesOf(const google::protobuf::EnumDescriptor* type) {
  std::string names;
  for (int i = 0; i < type->value_count(); ++i)
    absl::StrAppend(&names, i == 0 ? "" : ", ", type->value(i)->name());
  return names;
}

absl::StatusOr<Compare> CompareEnum(const FieldDescriptor* field, const FilterToken& value,
                                    const std::string& operation) {
  const auto* wanted = field->enum_type()->FindValueByName(value.text);
  if (wanted == nullptr) return BadValue(value, NamesOf(field->enum_type()));
  if (operation != "=" && operation != "!=") return BadValue(value, "the operator = or !=");
  return Compare([field, number = wanted->number()](const Message& message) -> std::optional<int> {
    return Order(message.GetReflection()->GetEnumValue(message, field), number);
  });
}

absl::StatusOr<Compare> CompareTime(const FieldDescriptor* field, const FilterToken& value) {
  absl::Time time;
  std::string error;
  if (!absl::ParseTime(absl::RFC3339_full, value.text, &time, &error))
    return BadValue(value, "a time such as \"2026-11-01T06:00:00Z\"");
  return Compare([field, time](const Message& message) -> std::optional<int> {
    if (!message.GetReflection()->HasField(message, field)) return std::nullopt;
    const auto& stored =
        static_cast<const Timestamp&>(message.GetReflection()->GetMessage(message, field));
    return Order(absl::FromUnixSeconds(stored.seconds()) + absl::Nanoseconds(stored.nanos()), time);
  });
}

}  // namespace

absl::StatusOr<Compare> MakeCompare(const FieldDescriptor* field, const FilterToken& value,
                                    const std::string& operation) {
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_STRING:
      return CompareText(field, value, operation);
    case FieldDescriptor::CPPTYPE_INT32:
    case FieldDescriptor::CPPTYPE_INT64:
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return CompareNumber(field, value);
    case FieldDescriptor::CPPTYPE_BOOL:
      return CompareBool(field, value);
    case FieldDescriptor::CPPTYPE_ENUM:
      return CompareEnum(field, value, operation);
    default:
      break;
  }
  const bool is_time = field->message_type() != nullptr &&
                       field->message_type()->full_name() == "google.protobuf.Timestamp";
  if (is_time) return CompareTime(field, value);
  return FilterFault(value.column, absl::StrCat("the field ", field->name()),
                     "a field that holds one text, number, time, enum, true or false");
}

}  // namespace truepose::resource
