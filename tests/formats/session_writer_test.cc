// What is written reads back equal, to the bit.
#include <cmath>
#include <random>

#include "formats/session_file.h"
#include "gmock/gmock.h"
#include "google/protobuf/util/message_differencer.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::google::protobuf::util::MessageDifferencer;

void ExpectRoundTrip(const v1::Nominal& nominal, const SessionFile& file) {
  const std::string text = WriteSessionFile(nominal, file.session, file.readings);
  const SessionFile again = ValueOf(ParseSessionFile(text, file.session.source(), nominal));
  EXPECT_TRUE(MessageDifferencer::Equals(again.session, file.session)) << text;
  ASSERT_EQ(again.readings.size(), file.readings.size()) << text;
  for (size_t i = 0; i < file.readings.size(); ++i) {
    EXPECT_TRUE(MessageDifferencer::Equals(again.readings[i], file.readings[i]))
        << again.readings[i].DebugString() << file.readings[i].DebugString();
  }
}

// Catches: a field that the writer forgets, or that it writes where the reader doesn't look.
TEST(SessionWriterTest, EveryFieldReadsBack) {
  const v1::Nominal nominal = RobotOf("RP");
  ExpectRoundTrip(nominal,
                  ValueOf(ParseSessionFile(
                      "time,placement,target,group,q1_deg,q2_mm,q1_cmd_deg,q2_cmd_mm,tau1_Nm,"
                      "tau2_Nm,x_mm,y_mm,z_mm,qx,qy,qz,qw,axis_x,axis_y,axis_z,sx_mm,sy_mm,"
                      "sz_mm,temp_C,note,\"a,b\"\n"
                      "2025-03-14T09:26:53Z,\" left \",T,\"g;1\",33.3,250.1,33.4,250.2,1.1,2.2,"
                      "1.1,2.2,3.3,0.5,0.5,0.5,0.5,0,0.6,0.8,0.01,0.02,0.03,20.1,\"x\"\"y\",1\n"
                      ",,,,1,2,,,,,,,,,,,,,,,,,,,,\n",
                      "s.csv", nominal)));
}

// Catches: digits lost anywhere between text and message; random readings with any group absent.
TEST(SessionWriterTest, RandomReadingsReadBackToTheBit) {
  std::mt19937_64 random(2024);
  std::uniform_real_distribution<double> value(-3, 3);
  const auto coin = [&] { return random() % 2 == 0; };
  const v1::Nominal nominal = RobotOf("RRP");
  SessionFile file;
  for (int row = 0; row < 500; ++row) {
    v1::Reading r;
    r.set_row(row);
    for (int i = 0; i < 3; ++i) r.add_joints_measured(value(random));
    if (coin()) {
      r.mutable_position_m()->set_x(value(random));
      r.mutable_position_m()->set_y(-0.0);
      r.mutable_position_m()->set_z(value(random) * 1e-9);
    }
    if (coin()) {
      const double half = value(random);
      r.mutable_orientation()->set_y(std::sin(half));
      r.mutable_orientation()->set_w(std::cos(half));
    }
    if (coin()) r.set_temperature_c(value(random));
    for (int point = 1; point <= 3; ++point) {
      if (!coin()) continue;
      v1::MeasuredPoint* measured = r.add_points();
      measured->set_target("p" + std::to_string(point));
      measured->mutable_position_m()->set_z(value(random));
      if (coin()) measured->mutable_position_sd_m()->set_x(std::abs(value(random)));
    }
    if (coin()) {
      r.set_distance_m(value(random));
      r.set_anchor("a,b");
      r.set_beam("1");
    }
    file.readings.push_back(r);
  }
  ExpectRoundTrip(nominal, file);
}

// Catches: columns of nothing, which a person would take for a fault.
TEST(SessionWriterTest, LeavesOutColumnsThatNothingFills) {
  const v1::Nominal nominal = RobotOf("RP");
  const SessionFile file =
      ValueOf(ParseSessionFile("q1_rad,q2_mm,x_mm,y_mm,z_mm,temp_C\n1,2,,,,\n", "s.csv", nominal));
  EXPECT_EQ(WriteSessionFile(nominal, file.session, file.readings), "q1_rad,q2_m\n1,0.002\n");
}

}  // namespace
}  // namespace truepose::formats
