#include "client/agent/lines/conversation.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "client/agent/intake/intake.h"
#include "gmock/gmock.h"
#include "tests/agent/spool/spool_testing.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::agent {
namespace {

constexpr double kNow = 1'780'000'000;  // 2026-05-28
constexpr char kReading[] =
    R"({"op":"reading","joints":[0,0.1,0.2,0.3,0.4,0.5],"position_mm":[1,2,3]})";

class ConversationTest : public ::testing::Test {
 protected:
  ConversationTest()
      : spool_(*Spool::Open({.folder = folder_.File("spool")}, disk_)),
        book_(*RequestBook::Open(folder_.File("spool/requests"), disk_, {"robots/arm"})),
        intake_({.agent = "cell", .joints = {{"robots/arm", 6}}}, *spool_, *book_, [] {}) {}

  // Answers as JSON, a line each.
  std::vector<Json> Say(const std::vector<std::string>& lines) {
    std::vector<Json> answers;
    const std::string text = conversation_.Answer(lines);
    for (const auto line : absl::StrSplit(text, '\n', absl::SkipEmpty()))
      answers.push_back(Json::parse(std::string(line)));
    return answers;
  }
  Json SayOne(const std::string& line) { return Say({line}).at(0); }
  static std::vector<std::string> FieldsOf(const Json& answer) {
    std::vector<std::string> fields;
    for (const Json& fault : answer.at("faults")) fields.push_back(fault.at("field"));
    return fields;
  }
  SessionProgress Begin() {
    const Json begun = SayOne(R"({"op":"begin","robot":"arm"})");
    EXPECT_TRUE(begun.at("ok")) << begun;
    return *intake_.Progress(begun.at("session"));
  }

  truepose::testing::TempDir folder_;
  testing::FaultyDisk disk_;
  std::unique_ptr<Spool> spool_;
  std::unique_ptr<RequestBook> book_;
  Intake intake_;
  int64_t taken_ = 0, refused_ = 0;
  const Desk desk_{
      .sink = intake_,
      .status = [] { return AgentStatus{.agent = "cell"}; },
      .decline = [this](const std::string& robot,
                        const std::string& reason) { return book_->Decline(robot, reason); },
      .now = [] { return kNow; },
      .largest_clock_difference_s = 86'400,
      .on_refused = [this] { ++refused_; },
      .on_taken = [this](int64_t readings) { taken_ += readings; }};
  Conversation conversation_{desk_};
};

// Would catch units that are mixed up, and a field that is read and then forgotten.
TEST_F(ConversationTest, AReadingWithEverything) {
  const std::string session = Begin().session;
  const Json answer = SayOne(
      R"({"op":"reading","joints_deg":[0,90,180,0,0,-90],"joints_commanded":[1,2,3,4,5,6],)"
      R"("position_mm":[1000,2,3],"position_sd_mm":[0.01,0.02,0.03],"quaternion":[0,0,0.7071,0.7071],)"
      R"("torques_nm":[1,2,3,4,5,6],"temperature_c":22.5,"time":"2026-05-28T20:26:40Z","group":"g",)"
      R"("target":"t","placement":"p","extra":["a","b"],"tag":17})");
  EXPECT_EQ(answer.dump(), R"({"ok":true,"number":1,"tag":17})");
  const v1::Reading reading = spool_->Find(session)->Read(1, 1)->front();
  EXPECT_NEAR(reading.joints_measured(1), M_PI / 2, 1e-15);
  EXPECT_EQ(reading.joints_commanded(5), 6);
  EXPECT_NEAR(reading.position_m().x(), 1, 1e-15);
  EXPECT_NEAR(reading.position_sd_m().z(), 3e-5, 1e-18);
  EXPECT_NEAR(reading.orientation().z(), std::sqrt(0.5), 1e-15) << "normalised";
  EXPECT_EQ(reading.joint_torques_nm(0), 1);
  EXPECT_EQ(reading.temperature_c(), 22.5);
  EXPECT_EQ(reading.time(), "2026-05-28T20:26:40Z");
  EXPECT_EQ(absl::StrCat(reading.group(), reading.target(), reading.placement()), "gtp");
  EXPECT_EQ(reading.extra_values_size(), 2);
}

// Would catch a bad message that takes a good one with it, and an error from which nobody can tell
// what is wrong.
TEST_F(ConversationTest, ABadMessageIsAnsweredAndTheRestGoesOn) {
  const std::string session = Begin().session;
  const auto answers =
      Say({kReading, "{\"op\":", R"({"op":"reading","joints":[1,2],"position_mm":[1,2,3]})",
           R"({"op":"reading","joints":[1,2,3,4,5,6],"position_mm":[1,2],"wrong":1})",
           R"({"op":"dance"})", "[1]", "", R"({"op":"begin","robot":"crane"})", kReading});
  ASSERT_EQ(answers.size(), 8u);
  EXPECT_EQ(answers[0].at("number"), 1);
  EXPECT_EQ(FieldsOf(answers[1]), std::vector<std::string>{"line"});
  EXPECT_EQ(FieldsOf(answers[2]), std::vector<std::string>{"readings[0].joints_measured"});
  EXPECT_EQ(FieldsOf(answers[3]), (std::vector<std::string>{"position_mm", "wrong"}));
  EXPECT_EQ(FieldsOf(answers[4]), std::vector<std::string>{"op"});
  EXPECT_EQ(FieldsOf(answers[5]), std::vector<std::string>{"line"});
  EXPECT_EQ(answers[6].at("code"), "NOT_FOUND");
  EXPECT_THAT(answers[6].at("message").get<std::string>(), ::testing::HasSubstr("robots/arm"));
  EXPECT_EQ(answers[7].at("number"), 2);
  EXPECT_EQ(spool_->Find(session)->readings(), 2);
  EXPECT_EQ(taken_, 2);
  EXPECT_EQ(refused_, 6);
}

// Would catch a line that ends the agent by the depth of its brackets.
TEST_F(ConversationTest, ALineOfBracketsIsRefused) {
  const std::string deep(60'000, '[');
  EXPECT_EQ(FieldsOf(SayOne(deep)), std::vector<std::string>{"line"});
  const std::string closed = deep + std::string(60'000, ']');
  EXPECT_EQ(FieldsOf(SayOne(absl::StrCat(R"({"op":"status","tag":)", closed, "}"))),
            std::vector<std::string>{"line"});
  EXPECT_TRUE(SayOne(R"({"op":"status","tag":"[[[[[[[[[[ \" [[[["})").at("ok"));
}

// Would catch one reading of a burst that spoils the others, or that another is stored for.
TEST_F(ConversationTest, OneOfABurstIsRefusedAlone) {
  Begin();
  const std::string wrong = R"({"op":"reading","joints":[1,2,3,4,5],"position_mm":[1,2,3]})";
  const auto answers = Say({kReading, wrong, kReading});
  EXPECT_EQ(answers[0].at("number"), 1);
  EXPECT_FALSE(answers[1].at("ok"));
  EXPECT_EQ(answers[2].at("number"), 2);
}

// Would catch a source that repeats what it wasn't answered for, and whose readings are doubled.
TEST_F(ConversationTest, ANumberedReadingMayBeRepeated) {
  const std::string session = Begin().session;
  const std::string first = absl::StrCat(R"({"number":1,)", kReading + 1);
  const std::string third = absl::StrCat(R"({"number":3,)", kReading + 1);
  EXPECT_EQ(SayOne(first).at("number"), 1);
  EXPECT_EQ(SayOne(first).at("number"), 1);
  EXPECT_EQ(SayOne(third).at("expected_number"), 2);
  EXPECT_EQ(spool_->Find(session)->readings(), 1);
  // From another connection, too.
  Conversation other(desk_);
  const std::string elsewhere = absl::StrCat(R"({"session":")", session, R"(",)", first.substr(1));
  EXPECT_EQ(Json::parse(other.Answer({elsewhere})).at("number"), 1);
}

// Would catch a clock that is years off and whose readings then lie before the calibration.
TEST_F(ConversationTest, AClockTenYearsOffIsNamed) {
  Begin();
  const auto with = [](const std::string& time) {
    return absl::StrCat(R"({"time":)", time, ",", kReading + 1);
  };
  EXPECT_EQ(FieldsOf(SayOne(with("\"2016-05-28T20:26:40Z\""))), std::vector<std::string>{"time"});
  EXPECT_EQ(FieldsOf(SayOne(with("\"yesterday\""))), std::vector<std::string>{"time"});
  EXPECT_EQ(FieldsOf(SayOne(with("1464467200"))), std::vector<std::string>{"time"});
  EXPECT_EQ(FieldsOf(SayOne(with("1e300"))), std::vector<std::string>{"time"});
  EXPECT_TRUE(SayOne(with("1780000001.5")).at("ok"));
}

// Would catch an answer that is given before the disk has the reading, or instead of it.
TEST_F(ConversationTest, AFullDiskIsAnsweredAsAnErrorUntilThereIsSpace) {
  const std::string session = Begin().session;
  disk_.countdown = 0;
  const auto answers = Say({kReading, kReading});
  EXPECT_EQ(answers[0].at("code"), "RESOURCE_EXHAUSTED");
  EXPECT_EQ(answers[1].at("code"), "RESOURCE_EXHAUSTED");
  EXPECT_EQ(spool_->Find(session)->readings(), 0);
  disk_.countdown = 1 << 30;
  EXPECT_EQ(SayOne(kReading).at("number"), 1);
}

// Would catch a begin that is not found again, and a seal of another number of readings.
TEST_F(ConversationTest, BeginAndSealMayBeRepeated) {
  const std::string begin =
      R"({"op":"begin","robot":"arm","id":"00000000-0000-4000-8000-000000000007"})";
  EXPECT_EQ(SayOne(begin).at("readings"), 0);
  EXPECT_EQ(FieldsOf(SayOne(R"({"op":"seal"})")), std::vector<std::string>{"readings"});
  Say({kReading, kReading});
  EXPECT_EQ(SayOne(begin).at("readings"), 2);
  EXPECT_FALSE(SayOne(R"({"op":"seal","readings":3})").at("ok"));
  EXPECT_TRUE(SayOne(R"({"op":"seal","readings":2})").at("sealed"));
  EXPECT_TRUE(SayOne(R"({"op":"seal"})").at("sealed"));
  EXPECT_EQ(SayOne(kReading).at("code"), "FAILED_PRECONDITION");
}

// Would catch a request whose poses nobody gets to see, a session that does not answer it, and a no
// without a reason.
TEST_F(ConversationTest, ARequestIsShownMeasuredAndDeclined) {
  EXPECT_EQ(SayOne(R"({"op":"request","robot":"arm"})").at("code"), "NOT_FOUND");
  v1::RecalibrationRequest request;
  request.set_name("robots/arm/recalibrationRequests/r");
  request.set_state(v1::REQUEST_PENDING);
  request.set_reason("it hit the fixture");
  ASSERT_TRUE(book_->Take("robots/arm", request).ok());
  v1::PoseSet poses;
  poses.add_poses()->add_joints(0.125);
  ASSERT_TRUE(book_->SetPoses("robots/arm", request.name(), poses.poses()).ok());
  const Json shown = SayOne(R"({"op":"request","robot":"arm"})");
  EXPECT_EQ(shown.at("reason"), "it hit the fixture");
  EXPECT_EQ(shown.at("poses")[0].at("joints")[0], 0.125);
  const std::string begin = R"({"op":"begin","robot":"arm","request":true})";
  const Json begun = SayOne(begin);
  EXPECT_EQ(spool_->Find(begun.at("session"))->request(), request.name());
  EXPECT_EQ(SayOne(begin).at("session"), begun.at("session")) << "the same is gone on with";
  EXPECT_EQ(FieldsOf(SayOne(R"({"op":"decline","robot":"arm"})")),
            std::vector<std::string>{"reason"});
  EXPECT_TRUE(SayOne(R"({"op":"decline","robot":"arm","reason":"replaced"})").at("ok"));
  const auto again = RequestBook::Open(folder_.File("spool/requests"), disk_, {"robots/arm"});
  EXPECT_EQ((*again)->Find("robots/arm")->decline_reason, "replaced") << "after a restart";
  EXPECT_EQ((*again)->Find("robots/arm")->poses.size(), 1u);
}

}  // namespace
}  // namespace truepose::agent
