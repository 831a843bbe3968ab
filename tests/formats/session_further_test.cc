// Points, single coordinates, distances and features in session files, and their faults word by
// word.
#include "formats/session_file.h"
#include "gmock/gmock.h"
#include "google/protobuf/util/message_differencer.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

SessionFile Parse(std::string_view text) {
  return ValueOf(ParseSessionFile(text, "s.csv", RobotOf("RR")));
}

std::vector<std::string> FaultsIn(std::string_view text) {
  return Faults(ParseSessionFile(text, "s.csv", RobotOf("RR")));
}

// Catches: points taken by their order instead of their number, a deviation given to another point.
TEST(SessionFurtherTest, ReadsSeveralPoints) {
  const SessionFile file = Parse(
      "q1_rad,q2_rad,p3_x_mm,p3_y_mm,p3_z_mm,p1_x_m,p1_y_m,p1_z_m,p3_sx_mm,p3_sy_mm,p3_sz_mm\n"
      "0,0,1,2,3,4,5,6,0.1,0.2,0.3\n"
      "1,0,,,,4,5,6,0.1,0.2,0.3\n"
      "2,0,1,2,3,,,,,,\n");
  ASSERT_EQ(file.readings.size(), 3);
  ASSERT_EQ(file.readings[0].points_size(), 2);
  EXPECT_EQ(file.readings[0].points(0).target(), "p1");
  EXPECT_EQ(file.readings[0].points(0).position_m().z(), 6);
  EXPECT_FALSE(file.readings[0].points(0).has_position_sd_m());
  EXPECT_EQ(file.readings[0].points(1).target(), "p3");
  EXPECT_EQ(file.readings[0].points(1).position_m().y(), 0.002);
  EXPECT_EQ(file.readings[0].points(1).position_sd_m().z(), 0.3 / 1000);
  ASSERT_EQ(file.readings[1].points_size(), 1);
  EXPECT_FALSE(file.readings[1].points(0).has_position_sd_m());
  EXPECT_EQ(file.readings[2].points(0).target(), "p3");
  EXPECT_FALSE(file.readings[0].has_position_m());
}

// Catches: a coordinate of 0 in the place of one that was not measured.
TEST(SessionFurtherTest, ReadsSingleCoordinates) {
  const SessionFile file =
      Parse("q1_rad,q2_rad,z_mm,y_mm,sz_mm,sy_mm\n0,0,3,,0.1,\n1,0,3,2,0.1,0.2\n2,0,,,,\n");
  ASSERT_EQ(file.readings.size(), 3);
  EXPECT_EQ(file.readings[0].coordinates(), "z");
  EXPECT_EQ(file.readings[0].position_m().z(), 0.003);
  EXPECT_EQ(file.readings[0].position_sd_m().z(), 0.1 / 1000);
  EXPECT_EQ(file.readings[0].position_sd_m().y(), 0);
  EXPECT_EQ(file.readings[1].coordinates(), "yz");
  EXPECT_FALSE(file.readings[2].has_position_m());
  EXPECT_THAT(file.warnings, ElementsAre("s.csv: only some of x, y, z are there and taken as they "
                                         "are: line 2"));
  EXPECT_THAT(Parse("q1_rad,q2_rad,z_mm\n0,0,3\n").warnings, IsEmpty());
  EXPECT_EQ(Parse("q1_rad,q2_rad,x_mm,y_mm,z_mm\n0,0,1,2,3\n").readings[0].coordinates(), "");
}

TEST(SessionFurtherTest, ReadsDistancesAndFeatures) {
  const SessionFile file = Parse(
      "q1_rad,q2_rad,distance_mm,distance_sd_mm,anchor,beam,feature\n"
      "0,0,1500,0.05,wall,,\n1,0,-2.5,,wall,laser,\n2,0,,0.05,,,hole 3\n");
  ASSERT_EQ(file.readings.size(), 3);
  EXPECT_EQ(file.readings[0].distance_m(), 1.5);
  EXPECT_EQ(file.readings[0].distance_sd_m(), 0.05 / 1000);
  EXPECT_EQ(file.readings[0].anchor(), "wall");
  EXPECT_EQ(file.readings[1].distance_m(), -0.0025);
  EXPECT_EQ(file.readings[1].beam(), "laser");
  EXPECT_FALSE(file.readings[1].has_distance_sd_m());
  EXPECT_FALSE(file.readings[2].has_distance_m());
  EXPECT_FALSE(file.readings[2].has_distance_sd_m());
  EXPECT_EQ(file.readings[2].feature(), "hole 3");
  EXPECT_THAT(file.session.extra_columns(), IsEmpty());
}

// Catches: a column that the writer forgets, an empty cell that comes back as 0.
TEST(SessionFurtherTest, WritesWhatItReads) {
  const v1::Nominal nominal = RobotOf("RR");
  const SessionFile file = Parse(
      "q1_rad,q2_rad,x_mm,z_mm,sx_mm,sz_mm,p2_x_mm,p2_y_mm,p2_z_mm,p2_sx_mm,p2_sy_mm,p2_sz_mm,"
      "distance_mm,distance_sd_mm,anchor,beam,feature\n"
      "0,0,1.1,2.2,0.1,0.2,1,2,3.3,0.1,0.2,0.3,1500.1,0.05,wall,b,f\n"
      "1,0,,2.2,,0.2,,,,,,,,,,,\n2,0,1.1,,0.1,,,,,,,,,,,,g\n");
  const std::string text = WriteSessionFile(nominal, file.session, file.readings);
  const SessionFile again = ValueOf(ParseSessionFile(text, "s.csv", nominal));
  ASSERT_EQ(again.readings.size(), 3) << text;
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(
        google::protobuf::util::MessageDifferencer::Equals(again.readings[i], file.readings[i]))
        << text;
  }
}

// Catches: half a point, or a coordinate without its weight.
TEST(SessionFurtherTest, NamesIncompleteColumns) {
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad,p1_x_mm,p1_y_mm\n0,0,1,2\n"),
              ElementsAre("s.csv:1: p1_z_mm: found no such column, expected one beside p1_x_mm"));
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad,p1_x_mm,p1_y_mm,p1_z_mm\n0,0,1,,3\n"),
              ElementsAre("s.csv:2: p1_y_mm: found an empty cell, expected a number, as p1_x_mm "
                          "has one"));
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad,x_mm,z_mm,sx_mm\n0,0,1,2,0.1\n"),
              ElementsAre("s.csv:1: sz_mm: found no such column, expected one beside sx_mm"));
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad,x_mm,z_mm,sx_mm,sz_mm\n0,0,1,2,0.1,\n"),
              ElementsAre("s.csv:2: sz_mm: found an empty cell, expected a number, as sx_mm has "
                          "one"));
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad,p2_sx_mm,p2_sy_mm,p2_sz_mm,distance_sd_mm\n0,0,1,1,1,1\n"),
              ElementsAre("s.csv:1: distance_sd_mm: found a deviation of nothing, expected "
                          "distance_mm or distance_m beside it",
                          "s.csv:1: p2_sx_mm: found a deviation of nothing, expected p2_x_mm or "
                          "p2_x_m beside it"));
}

TEST(SessionFurtherTest, NamesWrongHeaders) {
  EXPECT_THAT(
      FaultsIn("q1_rad,q2_rad,p10_x_mm,p0_sz_m,p1_x,distance,distance_sd,Anchor\n"
               "0,0,0,0,0,0,0,0\n"),
      ElementsAre("s.csv:1: p10_x_mm: found the header 'p10_x_mm', expected a point from 1 to 9",
                  "s.csv:1: p0_sz_m: found the header 'p0_sz_m', expected a point from 1 to 9",
                  "s.csv:1: p1_x: found the header 'p1_x', expected p1_x_mm or p1_x_m",
                  "s.csv:1: distance: found the header 'distance', expected distance_mm or "
                  "distance_m",
                  "s.csv:1: distance_sd: found the header 'distance_sd', expected distance_sd_mm "
                  "or distance_sd_m",
                  "s.csv:1: Anchor: found the header 'Anchor', expected anchor",
                  "s.csv:1: p1_y_mm or p1_y_m: found no such column, expected one beside p1_x",
                  "s.csv:1: p1_z_mm or p1_z_m: found no such column, expected one beside p1_x"));
}

// Catches: a distance of which nobody knows from where, a deviation that weighs by its square.
TEST(SessionFurtherTest, NamesWrongCells) {
  EXPECT_THAT(
      FaultsIn("q1_rad,q2_rad,distance_mm,distance_sd_mm,anchor,beam\n"
               "0,0,5,0.1,,\n1,0,-5,0.1,A,\n2,0,5,-0.1,A,\n3,0,far,0.1,A,\n"),
      ElementsAre(
          "s.csv:2: anchor: found no name, expected the point from which distance_mm was measured",
          "s.csv:3: distance_mm: found '-5', expected a distance, at least 0, or a name in the "
          "column beam",
          "s.csv:4: distance_sd_mm: found '-0.1', expected a standard deviation, at least 0",
          "s.csv:5: distance_mm: found 'far', expected a number"));
  EXPECT_THAT(
      FaultsIn("q1_rad,q2_rad,p1_x_mm,p1_y_mm,p1_z_mm,p1_sx_mm,p1_sy_mm,p1_sz_mm\n"
               "0,0,1,2,3,0.1,-0.2,0.1\n1,0,1,2,nan,0.1,0.2,0.1\n"),
      ElementsAre("s.csv:2: p1_sy_mm: found '-0.2', expected a standard deviation, at least 0",
                  "s.csv:3: p1_z_mm: found 'nan', expected a number"));
}

}  // namespace
}  // namespace truepose::formats
