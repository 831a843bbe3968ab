#include "client/agent/sources/json_line.h"

#include <string>

#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "google/protobuf/struct.pb.h"
#include "google/protobuf/util/json_util.h"

namespace truepose::agent {
namespace {

using google::protobuf::Message;
using google::protobuf::Struct;
using google::protobuf::Value;

constexpr char kExpected[] = R"({"begin": {}}, {"reading": {}} or {"seal": {}})";

absl::Status Fill(std::string_view json, std::string_view place, const std::string& expected,
                  Message* message) {
  const auto status =
      google::protobuf::util::JsonStringToMessage({json.data(), json.size()}, message);
  if (status.ok()) return absl::OkStatus();
  return FaultStatus(std::string(place), std::string(status.message()), expected);
}

// A value of the line as a message: back to JSON, since only that knows field names and types.
absl::Status Fill(const Value& value, std::string_view place, const std::string& expected,
                  Message* message) {
  std::string json;
  const auto status = google::protobuf::util::MessageToJsonString(value, &json);
  if (!status.ok()) return FaultStatus(std::string(place), "a value that is no JSON", expected);
  return Fill(json, place, expected, message);
}

absl::Status SetText(const Value& value, const std::string& field, std::string_view place,
                     std::string* text) {
  if (value.kind_case() != Value::kStringValue)
    return FaultStatus(std::string(place), "\"" + field + "\" that is no text", "a text");
  *text = value.string_value();
  return absl::OkStatus();
}

absl::StatusOr<JsonLine> ParseBegin(const Struct& begin, std::string_view place) {
  SessionStart start;
  for (const auto& [name, value] : begin.fields()) {
    absl::Status status;
    if (name == "session") {
      status = Fill(value, place, "a Session", &start.content);
    } else if (name == "id") {
      status = SetText(value, name, place, &start.id);
    } else if (name == "key") {
      status = SetText(value, name, place, &start.key);
    } else if (name == "for_request" && value.kind_case() == Value::kBoolValue) {
      start.for_request = value.bool_value();
    } else {
      status = FaultStatus(std::string(place), "\"" + name + "\" of begin",
                           "session, id, key, or for_request with true or false");
    }
    TRUEPOSE_RETURN_IF_ERROR(status);
  }
  return start;
}

}  // namespace

absl::StatusOr<JsonLine> ParseJsonLine(std::string_view text, std::string_view place) {
  Struct line;
  TRUEPOSE_RETURN_IF_ERROR(Fill(text, place, kExpected, &line));
  if (line.fields_size() != 1 || line.fields().begin()->second.kind_case() != Value::kStructValue)
    return FaultStatus(std::string(place), "another object", kExpected);
  const auto& [name, value] = *line.fields().begin();
  if (name == "begin") return ParseBegin(value.struct_value(), place);
  if (name == "seal") return SealLine{};
  if (name != "reading") return FaultStatus(std::string(place), "\"" + name + "\"", kExpected);
  v1::Reading reading;
  TRUEPOSE_RETURN_IF_ERROR(Fill(value, place, "a Reading", &reading));
  return reading;
}

}  // namespace truepose::agent
