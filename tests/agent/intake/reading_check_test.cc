#include "client/agent/intake/reading_check.h"

#include <limits>
#include <random>

#include "client/agent/intake/utf8.h"
#include "convert/run.h"
#include "gmock/gmock.h"

namespace truepose::agent {
namespace {

constexpr int kJoints = 6;

v1::Reading Sound() {
  v1::Reading reading;
  for (int joint = 0; joint < kJoints; ++joint) reading.add_joints_measured(0.2 * joint);
  reading.mutable_position_m()->set_x(1.5);
  reading.mutable_orientation()->set_w(1);
  return reading;
}

// Makes one thing of a reading odd; often it stays sound.
class Spoiler {
 public:
  v1::Reading Draw() {
    v1::Reading reading = Sound();
    for (int changes = Pick(3); changes > 0; --changes) Change(reading);
    return reading;
  }

 private:
  int Pick(int below) { return std::uniform_int_distribution<int>(0, below - 1)(random_); }
  double Figure() {
    const double figures[] = {0,
                              0.5,
                              -0.5,
                              1,
                              1 + 2e-6,
                              1 - 5e-7,
                              1e3,
                              -300,
                              2e4,
                              2e6,
                              std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()};
    return figures[Pick(std::size(figures))];
  }
  std::string Word() {
    const char* const words[] = {"", "x", "xy", "zx", "p1", "z"};
    return words[Pick(std::size(words))];
  }
  void Fill(v1::Vector3* v) { v->set_x(Figure()), v->set_y(Pick(2)), v->set_z(0); }
  void Change(v1::Reading& reading) {
    switch (Pick(14)) {
      case 0:
        return reading.add_joints_measured(Figure());
      case 1:
        return reading.set_joints_measured(Pick(kJoints), Figure());
      case 2:
        for (int i = Pick(3) + 5; i > 0; --i) reading.add_joints_commanded(Figure());
        return;
      case 3:
        for (int i = Pick(3) + 5; i > 0; --i) reading.add_joint_torques_nm(Figure());
        return;
      case 4:
        return Fill(reading.mutable_position_m());
      case 5:
        reading.clear_orientation();
        return;
      case 6:
        return reading.mutable_orientation()->set_w(Figure());
      case 7:
        return Fill(reading.mutable_axis());
      case 8:
        return Fill(reading.mutable_position_sd_m());
      case 9:
        return reading.set_coordinates(Word());
      case 10:
        return reading.set_temperature_c(Figure());
      case 11:
        reading.set_distance_m(Figure());
        reading.set_anchor(Word());
        reading.set_beam(Word());
        if (Pick(2) == 0) reading.set_distance_sd_m(Figure());
        return;
      case 12: {
        v1::MeasuredPoint& point = *reading.add_points();
        point.set_target(Word());
        if (Pick(4) > 0) Fill(point.mutable_position_m());
        if (Pick(2) == 0) Fill(point.mutable_position_sd_m());
        return;
      }
      default:
        return reading.clear_position_m();
    }
  }
  std::mt19937 random_{6};
};

bool ServerTakes(const v1::Reading& reading) {
  google::protobuf::RepeatedPtrField<v1::Reading> readings;
  *readings.Add() = reading;
  return convert::ValidateReadings(kJoints, readings, std::nullopt).ok();
}

bool AgentTakes(const v1::Reading& reading) {
  FaultList faults;
  CheckReading(reading, kJoints, "reading", &faults);
  return faults.empty();
}

// Would catch a reading that is let in and that the server then refuses for ever, so that all
// readings behind it wait, and one that is refused though the server would take it.
TEST(ReadingCheckTest, LetsInWhatTheServerTakes) {
  Spoiler spoiler;
  int sound = 0, refused = 0;
  for (int draw = 0; draw < 20'000; ++draw) {
    const v1::Reading reading = spoiler.Draw();
    const bool taken = ServerTakes(reading);
    ASSERT_EQ(AgentTakes(reading), taken) << reading.DebugString();
    ++(taken ? sound : refused);
  }
  EXPECT_GT(sound, 1'000) << "else the comparison says little";
  EXPECT_GT(refused, 1'000);
}

// What the server can't be asked for: it would get nothing that it can read.
TEST(ReadingCheckTest, RefusesWhatCantBeSentOrUsed) {
  v1::Reading reading = Sound();
  reading.set_group("caf\xE9");
  EXPECT_FALSE(AgentTakes(reading));
  reading.set_group("caf\xC3\xA9");
  EXPECT_TRUE(AgentTakes(reading));
  reading.add_extra_values(std::string(20'000, 'x'));
  EXPECT_FALSE(AgentTakes(reading));
  v1::Reading nowhere = Sound();
  nowhere.clear_joints_measured();
  EXPECT_FALSE(AgentTakes(nowhere));
}

// Would catch text that protobuf writes and then can't read.
TEST(Utf8Test, WellFormedOnly) {
  for (const char* text : {"", "plain", "\xC2\x80", "\xE0\xA0\x80", "\xED\x9F\xBF",
                           "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"})
    EXPECT_TRUE(IsUtf8(text)) << text;
  for (const char* text :
       {"\x80", "\xC0\x80", "\xC1\xBF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF0\x8F\xBF\xBF",
        "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xE2\x82", "a\xC3"})
    EXPECT_FALSE(IsUtf8(text)) << text;
}

}  // namespace
}  // namespace truepose::agent
