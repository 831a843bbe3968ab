// Every RPC that takes a request id, asked 1 to 5 times in parallel and once more after a restart:
// one effect, one answer. Driven by the descriptors: an RPC without a row in replay_rows.cc fails.
#include <google/protobuf/text_format.h>
#include <sqlite3.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <set>
#include <thread>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "absl/time/clock.h"
#include "client/append_readings.h"
#include "client/channel.h"
#include "server/calibration_runner.h"
#include "tests/integration/dynamic_call.h"
#include "tests/integration/replay_rows.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/expect_status.h"

namespace truepose {
namespace {

using google::protobuf::Message;
using google::protobuf::MethodDescriptor;
using testing::DynamicReply;
using testing::IsOk;
using testing::ReplayRow;
using testing::Stage;
using testing::Uuid;

constexpr char kSlow[] = "runs until it is cancelled";
constexpr int kReadings = 30;

// Sets a text or flag of a request, if it has such a field. @returns whether it has.
bool Set(Message& request, const std::string& field, const std::string& value) {
  const auto* descriptor = request.GetDescriptor()->FindFieldByName(field);
  if (descriptor == nullptr) return false;
  if (descriptor->cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_BOOL) {
    request.GetReflection()->SetBool(&request, descriptor, true);
  } else {
    request.GetReflection()->SetString(&request, descriptor, value);
  }
  return true;
}

std::set<std::string> MethodNames(bool with_request_id) {
  std::set<std::string> names;
  for (const MethodDescriptor* method : testing::AllMethods()) {
    const bool has_id = method->input_type()->FindFieldByName("request_id") != nullptr;
    if (has_id == with_request_id) names.insert(method->name());
  }
  return names;
}

// Rows of every table.
using Tally = std::map<std::string, int64_t>;

Tally operator-(Tally after, const Tally& before) {
  for (auto& [table, rows] : after) rows -= before.at(table);
  return after;
}

class ReplayTest : public testing::ServerFixture {
 protected:
  ReplayTest() {
    runner_.calibrate = [run = server::CalibrationRunner()](const v1::CalibrationInput& input,
                                                            const jobs::RunnerHooks& hooks) {
      const bool slow = input.sessions(0).session().display_name() == kSlow;
      while (slow && !hooks.is_cancelled()) absl::SleepFor(absl::Milliseconds(2));
      return slow ? absl::CancelledError("asked to end") : run(input, hooks);
    };
    Restart();
    Connect();
    for (const MethodDescriptor* method : testing::AllMethods()) methods_[method->name()] = method;
    v1::Nominal nominal = convert::MeasuringRobot();
    google::protobuf::TextFormat::PrintToString(nominal, &nominal_);
    nominal.set_serial(nominal.serial() + " after repair");
    google::protobuf::TextFormat::PrintToString(nominal, &changed_nominal_);
  }

  void Connect() { channel_ = client::MakeChannel(options_.listen); }

  std::unique_ptr<Message> RequestOf(const ReplayRow& row, int number) const {
    return testing::ParseRequest(
        *methods_.at(row.method),
        absl::StrReplaceAll(row.request, {{"$nominal", nominal_},
                                          {"$changed_nominal", changed_nominal_},
                                          {"$uuid", Uuid(number)},
                                          {"$table", Uuid(2'000'000 + number)},
                                          {"$n", std::to_string(number)}}));
  }
  DynamicReply Call(const std::string& method, const Message& request) const {
    return testing::CallMethod(channel_, *methods_.at(method), request);
  }
  DynamicReply MustCall(const std::string& method, const Message& request) const {
    DynamicReply reply = Call(method, request);
    EXPECT_TRUE(reply.status.ok()) << method << ": " << reply.status.error_message() << "\n"
                                   << request.DebugString();
    return reply;
  }

  bool IsImplemented(const std::string& method) const {
    const auto empty = testing::ParseRequest(*methods_.at(method), "");
    return Call(method, *empty).status.error_code() != grpc::StatusCode::UNIMPLEMENTED;
  }

  // What must be there before the row's request.
  void Prepare(const ReplayRow& row, int number) {
    for (const std::string& name : row.before) {
      const ReplayRow* const before = testing::FindReplayRow(name);
      ASSERT_NE(before, nullptr) << name;
      ASSERT_NO_FATAL_FAILURE(Prepare(*before, number));
      if (!HasFailure()) MustCall(name, *RequestOf(*before, number));
    }
    if (row.stage == Stage::kReadings) AppendReadings(number);
    if (row.stage == Stage::kRunningJob) BeginSlowJob(number);
    if (row.stage == Stage::kSecondActive) ActivateAnother(number);
    if (row.stage == Stage::kJobEnded) WaitForJobs();
  }

  void AppendReadings(int number) {
    const auto input = testing::MeasuringSession(kReadings, number);
    const std::vector<v1::Reading> readings(input.readings().begin(), input.readings().end());
    EXPECT_THAT(
        client::AppendReadings(NewClient(), absl::StrCat("sessions/", Uuid(number)), readings),
        IsOk());
  }
  void SealAndStart(int robot, int session, const std::string& display_name) {
    v1::CreateSessionRequest create;
    create.set_session_id(Uuid(session));
    create.mutable_session()->set_robot(absl::StrCat("robots/r-", robot));
    create.mutable_session()->set_display_name(display_name);
    MustCall("CreateSession", create);
    AppendReadings(session);
    v1::SealSessionRequest seal;
    seal.set_name(absl::StrCat("sessions/", Uuid(session)));
    seal.set_reading_count(kReadings);
    MustCall("SealSession", seal);
    MustCall("CreateCalibrationJob",
             testing::JobRequest(Uuid(session), absl::StrCat("r-", robot), Uuid(session)));
  }
  void BeginSlowJob(int number) {
    SealAndStart(number, number, kSlow);
    v1::GetCalibrationJobRequest request;
    request.set_name(absl::StrCat("jobs/", Uuid(number)));
    const client::Client client = NewClient();
    while (client.GetCalibrationJob(request)->state() == v1::PENDING)
      absl::SleepFor(absl::Milliseconds(2));
  }
  void ActivateAnother(int number) {
    SealAndStart(number, number + 500'000, "another");
    WaitForJobs();
    v1::ApproveCalibrationRequest approve;
    approve.set_name(absl::StrCat("robots/r-", number, "/calibrations/2"));
    approve.set_reason("newer");
    MustCall("ApproveCalibration", approve);
    v1::ActivateCalibrationRequest activate;
    activate.set_name(approve.name());
    MustCall("ActivateCalibration", activate);
  }
  // Until none is left that the server works on by itself.
  void WaitForJobs() const {
    const client::Client client = NewClient();
    for (bool busy = true; busy;) {
      const auto jobs = client.ListCalibrationJobs({});
      ASSERT_THAT(jobs, IsOk());
      busy = std::any_of(jobs->jobs().begin(), jobs->jobs().end(), [](const v1::CalibrationJob& j) {
        return j.state() == v1::PENDING || j.state() == v1::RUNNING;
      });
      if (busy) absl::SleepFor(absl::Milliseconds(2));
    }
  }

  Tally Count() const {
    sqlite3* database = nullptr;
    EXPECT_EQ(sqlite3_open(options_.database.c_str(), &database), SQLITE_OK);
    const auto first_column = [&](const std::string& sql) {
      std::vector<std::string> out;
      sqlite3_stmt* rows = nullptr;
      EXPECT_EQ(sqlite3_prepare_v2(database, sql.c_str(), -1, &rows, nullptr), SQLITE_OK) << sql;
      while (sqlite3_step(rows) == SQLITE_ROW)
        out.emplace_back(reinterpret_cast<const char*>(sqlite3_column_text(rows, 0)));
      sqlite3_finalize(rows);
      return out;
    };
    Tally tally;
    for (const std::string& table :
         first_column("SELECT name FROM sqlite_master WHERE type = 'table'"))
      tally[table] = std::stoll(first_column("SELECT COUNT(*) FROM " + table)[0]);
    sqlite3_close(database);
    return tally;
  }

  // Asks `times` times at once. @returns the one answer.
  std::string AskInParallel(const std::string& method, const Message& request, int times) const {
    std::vector<std::string> answers(times);
    std::vector<std::thread> clients;
    for (int i = 0; i < times; ++i)
      clients.emplace_back([&, i] { answers[i] = MustCall(method, request).bytes; });
    for (std::thread& client : clients) client.join();
    for (const std::string& answer : answers) EXPECT_EQ(answer, answers[0]) << method;
    return answers[0];
  }

  std::map<std::string, const MethodDescriptor*> methods_;
  std::shared_ptr<grpc::Channel> channel_;
  std::string nominal_, changed_nominal_;
};

// A request that was answered.
struct Asked {
  const ReplayRow* row;
  std::unique_ptr<Message> request;
  std::string answer;
};

// Would catch a new RPC that changes something and can't be repeated, and one that nobody tests.
TEST_F(ReplayTest, EveryRequestIdHasARow) {
  std::set<std::string> missing = MethodNames(true);
  // Its repeats answer with another secret, and a server without tokens makes none: tokens_test.cc.
  missing.erase("CreateToken");
  for (const ReplayRow& row : testing::ReplayRows()) {
    EXPECT_EQ(missing.erase(row.method), 1u)
        << row.method << " takes no request id, or has two rows";
  }
  EXPECT_EQ(missing, std::set<std::string>());
  std::set<std::string> without = MethodNames(false);
  std::erase_if(without, [](const std::string& name) {
    for (const char* reading :
         {"Get", "List", "Watch", "Evaluate", "Compensate", "Compare", "Download"})
      if (name.starts_with(reading)) return true;
    return false;
  });
  // Readings are addressed by (source, sequence); a report replaces the one before; the secret of
  // Bootstrap is used up.
  EXPECT_EQ(without,
            (std::set<std::string>{"AppendReadings", "Bootstrap", "ReportAgent", "RevokeToken"}));
}

// Would catch an effect that is made twice by requests that come together or again after a restart,
// an answer that tells the state of now, and an id that is taken for another request.
TEST_F(ReplayTest, OneEffectAndOneAnswer) {
  std::map<std::string, Tally> effects;
  for (const ReplayRow& row : testing::ReplayRows())
    ASSERT_TRUE(IsImplemented(row.method)) << row.method;
  int number = 0;
  for (int times = 1; times <= 5; ++times) {
    std::vector<Asked> asked;
    for (const ReplayRow& row : testing::ReplayRows()) {
      SCOPED_TRACE(absl::StrCat(row.method, ", ", times, " times"));
      ASSERT_NO_FATAL_FAILURE(Prepare(row, ++number));
      Asked& one = asked.emplace_back(Asked{&row, RequestOf(row, number), ""});
      Set(*one.request, "request_id", Uuid(1'000'000 + number));
      const Tally before = Count();
      one.answer = AskInParallel(row.method, *one.request, times);
      WaitForJobs();
      const Tally effect = Count() - before;
      if (times == 1) effects[row.method] = effect;
      EXPECT_EQ(effect, effects[row.method]) << "not the effect of one request";
      EXPECT_EQ(effect.at("replies"), 1);
      if (HasFailure()) return;
    }
    Restart();
    Connect();
    const Tally before = Count();
    for (const Asked& one : asked) {
      EXPECT_EQ(MustCall(one.row->method, *one.request).bytes, one.answer) << one.row->method;
      // The preview of a job or table stores nothing and looks up no id.
      const bool has_preview =
          one.row->method == "CreateCalibrationJob" || one.row->method == "CreateCompensationTable";
      if (!has_preview &&
          (Set(*one.request, "validate_only", "") || Set(*one.request, "reason", "another"))) {
        EXPECT_FALSE(Call(one.row->method, *one.request).status.ok()) << one.row->method;
      }
    }
    WaitForJobs();
    EXPECT_EQ(Count(), before) << "a repeat after the restart had an effect";
  }
  for (const auto& [method, effect] : effects)
    EXPECT_GT(effect.at("events") + effect.at("nominals"), 0) << method << " had no effect at all";
}

// The same of AppendReadings, whose request id is (source, sequence).
TEST_F(ReplayTest, ReadingsInParallelAndAfterARestart) {
  MustCall("CreateRobot", *RequestOf(*testing::FindReplayRow("CreateRobot"), 1));
  v1::CreateSessionRequest create;
  create.set_session_id(Uuid(2));
  create.mutable_session()->set_robot("robots/r-1");
  MustCall("CreateSession", create);
  v1::AppendReadingsRequest batch;
  batch.set_source(Uuid(3));
  batch.set_session(absl::StrCat("sessions/", Uuid(2)));
  *batch.mutable_readings() = testing::MeasuringSession(kReadings, 1).readings();
  const Tally before = Count();
  for (int round = 0; round < 3; ++round) {
    std::vector<std::thread> clients;
    for (int i = 0; i < 5; ++i) {
      clients.emplace_back([&] {
        const auto stream = NewClient().OpenAppendStream();
        v1::AppendReadingsRequest sent = batch;
        sent.set_first_sequence(1 + kReadings * round);
        v1::AppendReadingsResponse acknowledgement;
        EXPECT_TRUE(stream->Write(sent) && stream->Read(&acknowledgement));
        EXPECT_EQ(acknowledgement.durable_sequence(), kReadings * (round + 1));
        stream->WritesDone();
        EXPECT_THAT(stream->Finish(), IsOk());
      });
    }
    for (std::thread& client : clients) client.join();
    Restart();
    Connect();
    EXPECT_EQ((Count() - before).at("readings"), kReadings * (round + 1));
  }
}

}  // namespace
}  // namespace truepose
