#include "client/cli/json.h"

#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "core/base/fault.h"
#include "google/protobuf/util/json_util.h"

namespace truepose::cli {
namespace {

// Bytes of the UTF-8 sequence that `text` begins with; 0 when it begins with none. Overlong forms, surrogates and
// values above U+10FFFF are told by the second byte.
size_t SequenceLength(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  const unsigned lowest = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned highest = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  if (byte(1) < lowest || byte(1) > highest) return 0;
  for (size_t i = 2; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  return length;
}

std::string Escaped(char c) {
  switch (c) {
    case '"':
      return "\\\"";
    case '\\':
      return "\\\\";
    case '\n':
      return "\\n";
    case '\t':
      return "\\t";
    default:
      if (static_cast<unsigned char>(c) >= 0x20) return std::string(1, c);
      return absl::StrFormat("\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
}

std::string FaultJson(const Fault& fault) {
  return absl::StrCat("{\"field\":", JsonString(fault.field), ",\"found\":", JsonString(fault.found),
                      ",\"expected\":", JsonString(fault.expected), "}");
}

}  // namespace

std::string JsonString(std::string_view text) {
  std::string quoted = "\"";
  while (!text.empty()) {
    const size_t length = SequenceLength(text);
    if (length == 0) {
      quoted += "\\ufffd";
    } else if (length == 1) {
      quoted += Escaped(text[0]);
    } else {
      quoted += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return quoted + "\"";
}

absl::StatusOr<std::string> ToJson(const google::protobuf::Message& message, bool pretty) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  options.always_print_primitive_fields = true;
  options.add_whitespace = pretty;
  std::string json;
  const auto status = google::protobuf::util::MessageToJsonString(message, &json, options);
  if (!status.ok()) return absl::InternalError(status.ToString());
  return json;
}

absl::Status FromJson(std::string_view text, std::string_view file_name,
                      google::protobuf::Message* message) {
  const auto status = google::protobuf::util::JsonStringToMessage(std::string(text), message);
  if (status.ok()) return absl::OkStatus();
  return FaultStatus(std::string(file_name), std::string(status.message()),
                     absl::StrCat("the JSON of a ", message->GetDescriptor()->name()));
}

std::string ErrorJson(const absl::Status& status) {
  std::vector<std::string> faults;
  for (const Fault& fault : FaultsOf(status)) faults.push_back(FaultJson(fault));
  return absl::StrCat("{\"error\":{\"code\":", JsonString(absl::StatusCodeToString(status.code())),
                      ",\"message\":", JsonString(status.message()), ",\"faults\":[",
                      absl::StrJoin(faults, ","), "]}}");
}

}  // namespace truepose::cli
