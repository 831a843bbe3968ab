// Quaternions and Euler angles side by side.
#include <cmath>
#include <numbers>

#include "formats/session_file.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

absl::StatusOr<SessionFile> Parse(std::string_view text, const std::string& euler) {
  return ParseSessionFile(text, "s.csv", RobotOf("R"), {euler});
}

constexpr char kEuler[] = "q1_rad,rx_deg,ry_deg,rz_deg\n0,0,0,90\n";

// Catches: Euler angles that are taken for an orientation in a guessed convention.
TEST(SessionOrientationTest, EulerAnglesWithoutAConventionAreExtraColumns) {
  const SessionFile file = ValueOf(Parse(kEuler, ""));
  EXPECT_THAT(file.session.extra_columns(), ElementsAre("rx_deg", "ry_deg", "rz_deg"));
  ASSERT_EQ(file.readings.size(), 1);
  EXPECT_FALSE(file.readings[0].has_orientation());
  EXPECT_THAT(file.warnings,
              ElementsAre("s.csv: columns that are kept but not used: rx_deg, ry_deg, rz_deg "
                          "(rx_, ry_, rz_ are used when --euler names their convention)"));
}

TEST(SessionOrientationTest, EulerAnglesWithAConventionAreTheOrientation) {
  const SessionFile file = ValueOf(Parse(kEuler, "xyz-intrinsic"));
  ASSERT_EQ(file.readings.size(), 1);
  EXPECT_NEAR(file.readings[0].orientation().z(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(file.readings[0].orientation().w(), std::sqrt(0.5), 1e-15);
  EXPECT_THAT(file.session.extra_columns(), IsEmpty());
  EXPECT_THAT(file.warnings, IsEmpty());
}

// Catches: Euler angles that win over the quaternion: they agree to 1e-5 rad only, the quaternion's
// bits must stay.
TEST(SessionOrientationTest, TheQuaternionWins) {
  const SessionFile file = ValueOf(
      Parse("q1_rad,rx_rad,ry_rad,rz_rad,qx,qy,qz,qw\n0,0.00001,0,0,0,0,0,1\n", "xyz-intrinsic"));
  ASSERT_EQ(file.readings.size(), 1);
  EXPECT_EQ(file.readings[0].orientation().x(), 0);
}

// Catches: a file whose Euler angles have another convention than the user says.
TEST(SessionOrientationTest, ADisagreementIsAFault) {
  EXPECT_THAT(Faults(Parse("q1_rad,rx_rad,ry_rad,rz_rad,qx,qy,qz,qw\n"
                           "0,0.00009,0,0,0,0,0,1\n"
                           "1,0.001,0,0,0,0,0,-1\n",
                           "xyz-intrinsic")),
              ElementsAre("s.csv:3: rx_rad: found an orientation 0.001 rad away from qx,qy,qz,qw, "
                          "expected at most 0.0001 rad in the convention that is named"));
}

// Catches: a disagreement that is a fault although nobody named a convention.
TEST(SessionOrientationTest, WithoutAConventionNothingIsCompared) {
  EXPECT_TRUE(Parse("q1_rad,rx_deg,ry_deg,rz_deg,qx,qy,qz,qw\n0,50,0,0,0,0,0,1\n", "").ok());
}

TEST(SessionOrientationTest, EitherMayBeEmptyInARow) {
  const SessionFile file = ValueOf(
      Parse("q1_rad,rx_deg,ry_deg,rz_deg,qx,qy,qz,qw\n0,,,,0,0,0,1\n1,180,0,0,,,,\n2,,,,,,,\n",
            "zyx-extrinsic"));
  ASSERT_EQ(file.readings.size(), 3);
  EXPECT_EQ(file.readings[0].orientation().w(), 1);
  EXPECT_NEAR(file.readings[1].orientation().x(), 1, 1e-15);
  EXPECT_FALSE(file.readings[2].has_orientation());
}

TEST(SessionOrientationTest, NamesAnUnknownConventionAndMissingAngles) {
  EXPECT_THAT(
      Faults(Parse("q1_rad,rx_deg,rz_deg\n0,0,0\n", "rpy")),
      ElementsAre("euler: found 'rpy', expected three axes and -intrinsic or -extrinsic, such "
                  "as xyz-intrinsic",
                  "s.csv:1: ry_deg: found no such column, expected one beside rx_deg"));
}

TEST(SessionOrientationTest, WarnsOfAConventionWithoutAngles) {
  EXPECT_THAT(ValueOf(Parse("q1_rad\n0\n", "xyz-intrinsic")).warnings,
              ElementsAre("s.csv: no columns rx_, ry_, rz_ for the convention xyz-intrinsic"));
}

// Catches: a rounded quaternion that stays off unit length, and with it every residual of the row.
TEST(SessionOrientationTest, RoundedQuaternionsAreNormalised) {
  const SessionFile file = ValueOf(Parse("q1_rad,qx,qy,qz,qw\n0,0.7071,0,0,0.7071\n", ""));
  ASSERT_EQ(file.readings.size(), 1);
  EXPECT_NEAR(file.readings[0].orientation().x(), std::sqrt(0.5), 1e-15);
}

}  // namespace
}  // namespace truepose::formats
