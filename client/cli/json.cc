#include "client/cli/json.h"

#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "core/base/fault.h"
#include "formats/text_file.h"
#include "google/protobuf/util/json_util.h"

namespace truepose::cli {
namespace {

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
  return absl::StrCat("{\"field\":", JsonString(fault.field),
                      ",\"found\":", JsonString(fault.found),
                      ",\"expected\":", JsonString(fault.expected), "}");
}

}  // namespace

std::string JsonString(absl::string_view text) {
  std::string quoted = "\"";
  while (true) {
    const size_t bad = formats::FindNotUtf8({text.data(), text.size()});
    for (const char c : text.substr(0, bad)) quoted += Escaped(c);
    if (bad == std::string_view::npos) return quoted + "\"";
    quoted += "\\ufffd";
    text.remove_prefix(bad + 1);
  }
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

absl::Status FromJson(absl::string_view text, absl::string_view file_name,
                      google::protobuf::Message* message) {
  const auto status = google::protobuf::util::JsonStringToMessage(std::string(text), message);
  if (status.ok()) return absl::OkStatus();
  // The lines after the first draw an arrow under the place, which no longer fits behind a file's
  // name.
  const std::string reason(status.message());
  return FaultStatus(std::string(file_name), reason.substr(0, reason.find('\n')),
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
