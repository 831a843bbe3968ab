#include "client/agent/lines/session_json.h"

#include <utility>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"

namespace truepose::agent {
namespace {

v1::SessionPurpose PurposeOf(JsonFields& fields) {
  const std::string purpose = fields.Text("purpose").value_or("calibration");
  if (purpose == "calibration") return v1::CALIBRATION;
  if (purpose != "check") fields.AddFault("purpose", "'" + purpose + "'", "calibration or check");
  return v1::CHECK;
}

void FillContent(JsonFields& fields, v1::Session* content) {
  content->set_robot(RobotFromJson(fields));
  content->set_purpose(PurposeOf(fields));
  content->set_source(fields.Text("source").value_or("agent"));
  content->set_display_name(fields.Text("display_name").value_or(""));
  content->set_instrument(LongName(fields.Text("instrument").value_or(""), "instruments/"));
  content->set_fixture(LongName(fields.Text("fixture").value_or(""), "fixtures/"));
  content->set_operator_(fields.Text("operator").value_or(""));
  content->set_joint_source(fields.Text("joint_source").value_or(""));
  content->set_placement(
      LongName(fields.Text("placement").value_or(""), (content->robot() + "/placements/").c_str()));
  if (const auto temperature = fields.Number("temperature_c"))
    content->set_temperature_c(*temperature);
  if (const auto load = fields.Number("load_kg")) content->set_load_kg(*load);
  for (std::string& column : fields.Texts("extra_columns").value_or(std::vector<std::string>()))
    content->add_extra_columns(std::move(column));
}

}  // namespace

std::string LongName(const std::string& text, const char* prefix) {
  return text.empty() || absl::StartsWith(text, prefix) ? text : absl::StrCat(prefix, text);
}

std::string RobotFromJson(JsonFields& fields) {
  const auto robot = fields.Text("robot");
  if (!robot.has_value() || robot->empty()) fields.AddFault("robot", "nothing", "a robot's name");
  return LongName(robot.value_or(""), "robots/");
}

SessionStart StartFromJson(JsonFields& fields) {
  SessionStart start;
  FillContent(fields, &start.content);
  start.id = fields.Text("id").value_or("");
  start.for_request = fields.Flag("request").value_or(false);
  return start;
}

}  // namespace truepose::agent
