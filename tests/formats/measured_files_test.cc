// The measured data sets and the common problems, as they are on disk.
#include <cstdlib>

#include "formats/robot_file.h"
#include "formats/session_file.h"
#include "gmock/gmock.h"
#include "google/protobuf/util/message_differencer.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string Shared(const std::string& path) {
  const char* folder = std::getenv("TRUEPOSE_SHARED");
  EXPECT_NE(folder, nullptr) << "TRUEPOSE_SHARED is not set";
  return std::string(folder == nullptr ? "" : folder) + "/" + path;
}

SessionFile Read(const std::string& path, std::string_view joints, const std::string& euler = "") {
  return ValueOf(ReadSessionFile(Shared(path), RobotOf(joints), {euler}));
}

// Catches: columns of a real export that get lost or are taken for others.
TEST(MeasuredFilesTest, Ur10) {
  const SessionFile c = Read("data/ipa_ur10/series_C.csv", "RRRRRR");
  ASSERT_EQ(c.readings.size(), 2773);
  EXPECT_EQ(Read("data/ipa_ur10/series_D.csv", "RRRRRR").readings.size(), 632);
  EXPECT_THAT(c.session.extra_columns(),
              ElementsAre("rx_deg", "ry_deg", "rz_deg", "goal_x_m", "goal_y_m", "goal_z_m",
                          "goal_roll", "goal_pitch", "goal_yaw"));
  EXPECT_EQ(c.session.source(), "series_C.csv");
  EXPECT_EQ(c.warnings.size(), 1);
  const v1::Reading& last = c.readings.back();
  EXPECT_EQ(last.row(), 2772);
  const v1::Reading& first = c.readings.front();
  EXPECT_EQ(first.joints_measured(0), -3.14159);
  EXPECT_EQ(first.position_m().y(), -3240.7562 / 1000);
  EXPECT_NEAR(first.orientation().w(), 0.578436625, 1e-8);
  EXPECT_EQ(first.position_sd_m().x(), 0.041565 / 1000);
  EXPECT_EQ(first.temperature_c(), 21.6800003);
  EXPECT_EQ(first.extra_values(8), "-0.000186977");
}

// Catches: Euler angles of the wrong convention: the file's own quaternions say that these are
// intrinsic XYZ.
TEST(MeasuredFilesTest, Ur10EulerAnglesAgreeWithItsQuaternionsInOneConvention) {
  EXPECT_EQ(Read("data/ipa_ur10/series_C.csv", "RRRRRR", "xyz-intrinsic").readings.size(), 2773);
  EXPECT_FALSE(
      ReadSessionFile(Shared("data/ipa_ur10/series_C.csv"), RobotOf("RRRRRR"), {"zyx-intrinsic"})
          .ok());
}

TEST(MeasuredFilesTest, Pandas) {
  const SessionFile sockets = Read("data/mukca_panda/panda_3.csv", "RRRRRRR");
  ASSERT_EQ(sockets.readings.size(), 387);
  EXPECT_THAT(sockets.session.extra_columns(), ElementsAre("hole"));
  EXPECT_EQ(sockets.readings[0].placement(), "backcenter");
  EXPECT_FALSE(sockets.readings[0].has_position_m());
  const SessionFile camera = Read("data/philnad_panda/poses.csv", "RRRRRRR");
  EXPECT_EQ(camera.readings.size(), 114);
  EXPECT_THAT(camera.warnings, IsEmpty());
}

// Catches: metres taken for millimetres, a quaternion whose w stands first taken as x.
TEST(MeasuredFilesTest, CommonProblems) {
  const SessionFile arm6 = Read("bench/arm6_81.csv", "RRRRRR");
  ASSERT_EQ(arm6.readings.size(), 81);
  EXPECT_EQ(arm6.readings[0].position_m().x(), -0.58032587959643);
  EXPECT_NEAR(arm6.readings[0].orientation().w(), 0.858172431088611, 1e-14);
  EXPECT_EQ(Read("bench/arm6_1000.csv", "RRRRRR").readings.size(), 1000);
  EXPECT_EQ(Read("bench/arm5_81.csv", "RRRRR").readings.size(), 81);
  EXPECT_EQ(Read("bench/arm5_1000.csv", "RRRRR").readings.size(), 1000);
}

// Catches: measured values that change when a session is exported.
TEST(MeasuredFilesTest, MeasuredSessionsReadBackToTheBit) {
  const v1::Nominal robot = RobotOf("RRRRRR");
  const SessionFile c = Read("data/ipa_ur10/series_C.csv", "RRRRRR");
  const SessionFile again = ValueOf(ParseSessionFile(WriteSessionFile(robot, c.session, c.readings),
                                                     "series_C.csv", robot, {.euler = ""}));
  ASSERT_EQ(again.readings.size(), c.readings.size());
  for (size_t i = 0; i < c.readings.size(); ++i) {
    ASSERT_TRUE(
        google::protobuf::util::MessageDifferencer::Equals(again.readings[i], c.readings[i]));
  }
}

// Catches: a file of another kind that is read as a session.
TEST(MeasuredFilesTest, ParametersAreNoSession) {
  EXPECT_THAT(Faults(ReadSessionFile(Shared("bench/arm6_params.csv"), RobotOf("RRRRRR"))),
              ::testing::Contains(::testing::HasSubstr("found no column of a joint")));
}

}  // namespace
}  // namespace truepose::formats
