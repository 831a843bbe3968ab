#include "client/agent/sources/json_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <thread>

#include "tests/agent/sources/fake_sink.h"

namespace truepose::agent {
namespace {

using ::testing::HasSubstr;

std::string Reading(const std::string& q) {
  return R"({"op": "reading", "joints": [)" + q + R"(, 0], "position_mm": [100, 0, 0]})" + "\n";
}

class JsonSourceTest : public ::testing::Test {
 protected:
  JsonSourceTest() { EXPECT_EQ(pipe(pipe_), 0); }
  ~JsonSourceTest() override {
    CloseInput();
    Join();
    close(pipe_[0]);
  }

  void StartSource(std::optional<SettleOptions> settle = {}) {
    JsonSourceOptions options;
    options.descriptor = pipe_[0];
    options.content.set_robot("robots/r");
    options.settle = settle;
    thread_ = std::thread([this, options] {
      EXPECT_TRUE(JsonSource(options, faults_.Report()).Run(sink_, stop_).ok());
    });
  }
  void Write(const std::string& text) const {
    EXPECT_EQ(write(pipe_[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void CloseInput() {
    if (pipe_[1] >= 0) close(pipe_[1]);
    pipe_[1] = -1;
  }
  void Join() {
    if (thread_.joinable()) thread_.join();
  }
  // Everything, from the beginning to the end of the input.
  void Read(const std::string& text, std::optional<SettleOptions> settle = {}) {
    StartSource(settle);
    Write(text);
    CloseInput();
    Join();
  }

  int pipe_[2] = {-1, -1};
  const Stop stop_;
  FakeSink sink_;
  Faults faults_;
  std::thread thread_;
};

// Would catch a reading that waits for the next one before it is durable.
TEST_F(JsonSourceTest, AReadingIsHandedOverAtOnce) {
  StartSource();
  Write(Reading("1.5"));
  ASSERT_TRUE(sink_.WaitFor([](const auto& sessions) {
    return sessions.size() == 1 && sessions[0].readings.size() == 1;
  }));
  EXPECT_EQ(sink_.Sessions()[0].content.robot(), "robots/r");
  stop_.Request();
  Join();
}

constexpr char kBegin[] = "{\"op\": \"begin\"}\n", kSeal[] = "{\"op\": \"seal\"}\n";

TEST_F(JsonSourceTest, SessionsBeginAndAreSealed) {
  Read(R"({"op": "begin", "robot": "s", "operator": "Ada", "id": "u", "purpose": "check"})"
       "\r\n" +
       Reading("1") + Reading("2") + kSeal + "\n" + kBegin +
       Reading("3").substr(0, Reading("3").size() - 1));
  const std::vector<FakeSession> sessions = sink_.Sessions();
  ASSERT_EQ(sessions.size(), 2u);
  EXPECT_EQ(sessions[0].content.robot(), "robots/s");
  EXPECT_EQ(sessions[0].content.operator_(), "Ada");
  EXPECT_EQ(sessions[0].content.purpose(), v1::CHECK);
  EXPECT_EQ(FakeSink::Joints(sessions[0]), "1 2");
  EXPECT_TRUE(sessions[0].sealed);
  EXPECT_EQ(sessions[1].content.robot(), "robots/r");
  EXPECT_EQ(FakeSink::Joints(sessions[1]), "3");
  EXPECT_FALSE(sessions[1].sealed);
  EXPECT_EQ(faults_.Text(), "");
}

// Would catch one bad line that ends the stream, and a line number that is off.
TEST_F(JsonSourceTest, BadLinesAreReportedAndTheRestGoesOn) {
  Read(Reading("1") + "{oh\n" +
       R"({"op": "reading", "joint": 1})"
       "\n[1]\n"
       R"({"op": "read"})"
       "\n" +
       std::string(70'000, 'x') +
       "\n"
       R"({"op": "begin", "what": 1, "operator": 2})"
       "\n" +
       Reading("2"));
  ASSERT_EQ(sink_.Sessions().size(), 1u);
  EXPECT_EQ(FakeSink::Joints(sink_.Sessions()[0]), "1 2");
  for (const char* place :
       {"stdin:2: line: found no JSON object", "stdin:3: joint: found a key that is not known",
        "stdin:4: line: ", "stdin:5: op: found 'read', expected one of begin, reading, seal",
        "stdin:6: found more than 65536 bytes", "stdin:7: what: ", "stdin:7: operator: "})
    EXPECT_THAT(faults_.Text(), HasSubstr(place));
}

// Would catch readings of a refused session that are counted to another.
TEST_F(JsonSourceTest, ARefusedSessionTakesNoReadings) {
  sink_.RefuseBegin(absl::NotFoundError("no robot x"));
  Read(kBegin + Reading("1") + Reading("2"));
  EXPECT_TRUE(sink_.Sessions().empty());
  EXPECT_THAT(faults_.Text(), HasSubstr("stdin:1"));
  EXPECT_THAT(faults_.Text(), HasSubstr("no robot x"));
  EXPECT_THAT(faults_.Text(), HasSubstr("stdin:3: found a reading of a session that was refused"));
}

TEST_F(JsonSourceTest, SealingNeedsASession) {
  Read(kSeal + Reading("1") + kSeal + Reading("2"));
  EXPECT_EQ(FakeSink::Joints(sink_.Sessions()[0]), "1");
  EXPECT_EQ(sink_.Sessions()[0].content.source(), "stdin");
  EXPECT_THAT(faults_.Text(), HasSubstr("a seal without a session"));
  EXPECT_THAT(faults_.Text(),
              HasSubstr("stdin:4: found a reading of a session that was refused or sealed"));
}

// The writer sends all again after a break; would catch readings that come twice.
TEST_F(JsonSourceTest, WhatIsSentAgainHasNoEffect) {
  const std::string all = R"({"op": "begin", "id": "u"})"
                          "\n" +
                          Reading("1") + Reading("2");
  StartSource();
  Write(all + all + Reading("3"));
  CloseInput();
  Join();
  ASSERT_EQ(sink_.Sessions().size(), 1u);
  EXPECT_EQ(FakeSink::Joints(sink_.Sessions()[0]), "1 2 3");
  EXPECT_EQ(faults_.Text(), "");
}

TEST_F(JsonSourceTest, StandstillsNeedTimes) {
  Read(Reading("1"), SettleOptions{});
  EXPECT_THAT(faults_.Text(), HasSubstr("stdin:1: time: found ''"));
}

}  // namespace
}  // namespace truepose::agent
