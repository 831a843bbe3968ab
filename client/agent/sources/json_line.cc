#include "client/agent/sources/json_line.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "client/agent/lines/reading_json.h"
#include "client/agent/lines/session_json.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

// Calls `read` with the fields of the line; whatever it didn't ask for is a fault.
template <class Read>
absl::StatusOr<JsonLine> ReadFields(const Json& line, const Read& read) {
  FaultList faults;
  JsonFields fields(line, faults);
  fields.Ignore("op");
  JsonLine result = read(fields);
  fields.RefuseOthers();
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  return result;
}

void FillDefaults(const v1::Session& defaults, Json* line) {
  if (!defaults.robot().empty() && !line->contains("robot")) (*line)["robot"] = defaults.robot();
  if (defaults.purpose() == v1::CHECK && !line->contains("purpose")) (*line)["purpose"] = "check";
}

absl::StatusOr<JsonLine> ParseLine(Json line, const v1::Session& defaults) {
  if (!line.is_object()) return FaultStatus("line", "no JSON object", "a JSON object");
  const auto op = line.find("op");
  const std::string word = op != line.end() && op->is_string() ? op->get<std::string>() : "";
  if (word == "reading") {
    return ReadFields(line, [](JsonFields& fields) { return ReadingFromJson(fields, {}); });
  }
  if (word == "begin") {
    FillDefaults(defaults, &line);
    return ReadFields(line, [](JsonFields& fields) { return StartFromJson(fields); });
  }
  if (word == "seal") {
    return ReadFields(line, [](JsonFields&) { return SealLine{}; });
  }
  return FaultStatus("op", word.empty() ? "nothing" : "'" + word + "'",
                     "one of begin, reading, seal");
}

}  // namespace

absl::StatusOr<JsonLine> ParseJsonLine(std::string_view text, std::string_view place,
                                       const v1::Session& defaults) {
  auto parsed = ParseLine(Json::parse(text, nullptr, false), defaults);
  if (parsed.ok()) return parsed;
  FaultList faults;
  faults.AddAll(parsed.status(), absl::StrCat(std::string(place), ": "));
  return faults.ToStatus();
}

}  // namespace truepose::agent
