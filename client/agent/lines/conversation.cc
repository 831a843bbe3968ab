#include "client/agent/lines/conversation.h"

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "client/agent/lines/session_json.h"
#include "client/agent/lines/status_json.h"
#include "core/base/error_metadata.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

constexpr int kDeepest = 8;
constexpr char kOps[] = "begin, reading, seal, status, request, decline";

std::string CodeText(const absl::Status& status) { return absl::StatusCodeToString(status.code()); }

Json ErrorJson(const absl::Status& status) {
  Json faults = Json::array();
  for (const Fault& fault : FaultsOf(status))
    faults.push_back(
        {{"field", fault.field}, {"found", fault.found}, {"expected", fault.expected}});
  Json error = {{"ok", false},
                {"code", CodeText(status)},
                {"message", std::string(status.message())},
                {"faults", faults}};
  for (const auto& [name, value] : ErrorMetadataOf(status)) {
    int64_t number = 0;
    error[name] = absl::SimpleAtoi(value, &number) ? Json(number) : Json(value);
  }
  return error;
}

Json DoneJson(Json content) {
  Json answer = {{"ok", true}};
  answer.update(content);
  return answer;
}

}  // namespace

std::string Conversation::Answer(const std::vector<std::string>& lines) {
  for (const std::string& line : lines)
    if (line.find_first_not_of(" \t\r") != std::string::npos) Take(line);
  Flush();
  return std::exchange(out_, "");
}

std::string Conversation::AnswerTooLong(size_t most) const {
  desk_.on_refused();
  return ErrorJson(FaultStatus("line", absl::StrCat("more than ", most, " bytes"),
                               absl::StrCat("at most ", most, " bytes")))
             .dump() +
         "\n";
}

void Conversation::Reply(absl::StatusOr<Json> answer, const Json& tag) {
  Json reply = answer.ok() ? DoneJson(*std::move(answer)) : ErrorJson(answer.status());
  if (!answer.ok()) desk_.on_refused();
  if (!tag.is_null()) reply["tag"] = tag;
  absl::StrAppend(&out_, reply.dump(-1, ' ', false, Json::error_handler_t::replace), "\n");
}

void Conversation::Take(const std::string& line) {
  Json message = IsDeeperThan(line, kDeepest) ? Json() : Json::parse(line, nullptr, false);
  if (!message.is_object()) {
    Flush();
    return Reply(FaultStatus("line", FoundText(Json(line)), "a JSON object"), Json());
  }
  const Json tag = message.value("tag", Json());
  message.erase("tag");
  const auto op = message.find("op");
  const std::string word = op != message.end() && op->is_string() ? op->get<std::string>() : "";
  if (word == "reading") {
    message["tag"] = tag;
    return TakeReading(message);
  }
  Flush();
  Reply(Do(word, message), tag);
}

std::string Conversation::SessionOf(JsonFields& fields) const {
  const auto session = fields.Text("session");
  if (session.has_value()) return LongName(*session, "sessions/");
  if (session_.empty())
    fields.AddFault("session", "nothing, and none begun in this connection", "a session");
  return session_;
}

void Conversation::TakeReading(const Json& message) {
  FaultList faults;
  JsonFields fields(message, faults);
  fields.Ignore("op");
  const std::string session = SessionOf(fields);
  const bool follows = !waiting_.empty() && waiting_session_ == session;
  const int64_t next =
      follows ? waiting_first_ + static_cast<int64_t>(waiting_.size()) : next_number_;
  const auto said = fields.Whole("number");
  const int64_t number = said.value_or(next);
  if (!said.has_value() && session != session_)
    fields.AddFault("number", "nothing", "the reading's number in its session, counted from 1");
  v1::Reading reading = ReadingFromJson(
      fields,
      {.now_s = desk_.now(), .largest_clock_difference_s = desk_.largest_clock_difference_s});
  const Json tag = message.at("tag");
  fields.Ignore("tag");
  fields.RefuseOthers();
  if (!faults.empty() || !follows || number != next) Flush();
  if (!faults.empty()) return Reply(faults.ToStatus(), tag);
  if (waiting_.empty()) waiting_first_ = number;
  waiting_session_ = session;
  waiting_.push_back({std::move(reading), tag, said.has_value()});
}

void Conversation::Flush() {
  const std::vector<Waiting> waiting = std::exchange(waiting_, {});
  if (waiting.empty()) return;
  std::vector<v1::Reading> readings;
  for (const Waiting& one : waiting) readings.push_back(one.reading);
  const auto has = desk_.sink.Append(waiting_session_, waiting_first_, readings);
  // One of them spoils it for all: each is then answered for itself.
  if (!has.ok() && waiting.size() > 1) return FlushOneByOne(waiting);
  for (size_t i = 0; i < waiting.size(); ++i) {
    const int64_t number = waiting_first_ + static_cast<int64_t>(i);
    Reply(has.ok() ? absl::StatusOr<Json>(Json{{"number", number}}) : has.status(), waiting[i].tag);
  }
  if (!has.ok()) return;
  desk_.on_taken(static_cast<int64_t>(waiting.size()));
  if (waiting_session_ == session_) next_number_ = *has + 1;
}

// Behind one that is refused, a reading that says its number is refused for the gap, and its source
// sends both again; one without takes the place.
void Conversation::FlushOneByOne(const std::vector<Waiting>& waiting) {
  const int64_t first = waiting_first_;
  for (size_t i = 0; i < waiting.size(); ++i) {
    waiting_first_ = waiting[i].is_numbered ? first + static_cast<int64_t>(i) : next_number_;
    waiting_.push_back(waiting[i]);
    Flush();
  }
}

absl::StatusOr<Json> Conversation::Do(const std::string& op, const Json& message) {
  if (op == "begin") return Begin(message);
  if (op == "seal") return Seal(message);
  if (op == "request") return Request(message);
  if (op == "decline") return Decline(message);
  if (op == "status") return StatusJson(desk_.status());
  const auto further = desk_.operations.find(op);
  if (further != desk_.operations.end()) return further->second(message);
  std::string known = absl::StrCat("one of ", kOps);
  for (const auto& operation : desk_.operations) absl::StrAppend(&known, ", ", operation.first);
  return FaultStatus("op", op.empty() ? "nothing" : "'" + op + "'", std::move(known));
}

absl::StatusOr<Json> Conversation::Begin(const Json& message) {
  FaultList faults;
  JsonFields fields(message, faults);
  fields.Ignore("op");
  const SessionStart start = StartFromJson(fields);
  fields.RefuseOthers();
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  TRUEPOSE_ASSIGN_OR_RETURN(const SessionProgress begun, desk_.sink.Begin(start));
  session_ = begun.session;
  next_number_ = begun.readings + 1;
  return ProgressJson(begun);
}

absl::StatusOr<Json> Conversation::Seal(const Json& message) {
  FaultList faults;
  JsonFields fields(message, faults);
  fields.Ignore("op");
  const std::string session = SessionOf(fields);
  const auto readings = fields.Whole("readings");
  if (!readings.has_value() && session != session_)
    fields.AddFault("readings", "nothing", "how many readings the session has");
  fields.RefuseOthers();
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  TRUEPOSE_ASSIGN_OR_RETURN(const SessionProgress sealed,
                            desk_.sink.Seal(session, readings.value_or(next_number_ - 1)));
  return ProgressJson(sealed);
}

absl::StatusOr<Json> Conversation::Request(const Json& message) const {
  FaultList faults;
  JsonFields fields(message, faults);
  fields.Ignore("op");
  const std::string robot = RobotFromJson(fields);
  fields.RefuseOthers();
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  TRUEPOSE_ASSIGN_OR_RETURN(const MeasuringTask task, desk_.sink.Task(robot));
  return TaskJson(task);
}

absl::StatusOr<Json> Conversation::Decline(const Json& message) const {
  FaultList faults;
  JsonFields fields(message, faults);
  fields.Ignore("op");
  const std::string robot = RobotFromJson(fields);
  const std::string reason = fields.Text("reason").value_or("");
  fields.RefuseOthers();
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  TRUEPOSE_RETURN_IF_ERROR(desk_.decline(robot, reason));
  return Json::object();
}

}  // namespace truepose::agent
