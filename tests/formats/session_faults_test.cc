// Every fault of a session file, word by word: what a person reads has to name line, column, found
// and expected.
#include "formats/session_file.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<std::string> FaultsIn(std::string_view text, std::string_view joints = "RR") {
  return Faults(ParseSessionFile(text, "s.csv", RobotOf(joints)));
}

// Catches: a joint that is silently taken as 0, a message that doesn't say which one is missing.
TEST(SessionFaultsTest, NamesAMissingColumn) {
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad,q3_rad,q5_rad,q6_rad\n0,0,0,0,0\n", "RRRRRR"),
              ElementsAre("s.csv:1: q4_rad: found no such column, expected one beside q1_rad"));
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad,x_mm,y_mm,axis_x,axis_y,axis_z\n0,0,1,2,0,0,1\n"),
              ElementsAre("s.csv:1: z_mm: found no such column, expected one beside x_mm"));
  EXPECT_THAT(
      FaultsIn("q2_rad\n0\n", "PR"),
      ElementsAre("s.csv:1: q1_mm or q1_m: found no such column, expected one beside q2_rad"));
}

TEST(SessionFaultsTest, NamesThatThereAreNoJoints) {
  EXPECT_THAT(FaultsIn("x_mm,y_mm,z_mm\n1,2,3\n"),
              ElementsAre("s.csv:1: found no column of a joint, expected q1_rad to q2_rad, or "
                          "q1_cmd_rad to q2_cmd_rad"));
}

// Catches: a unit guessed, one fault reported as two.
TEST(SessionFaultsTest, NamesTheRightHeaderForAMissingOrWrongUnit) {
  EXPECT_THAT(FaultsIn("q1,q2_mm,x,y_in,z_MM,temp_F,qx_rad,qy,qz,qw\n0,0,0,0,0,0,0,0,0,1\n"),
              ElementsAre("s.csv:1: q1: found the header 'q1', expected q1_deg or q1_rad",
                          "s.csv:1: q2_mm: found the header 'q2_mm', expected q2_deg or q2_rad",
                          "s.csv:1: x: found the header 'x', expected x_mm or x_m",
                          "s.csv:1: y_in: found the header 'y_in', expected y_mm or y_m",
                          "s.csv:1: z_MM: found the header 'z_MM', expected z_mm or z_m",
                          "s.csv:1: temp_F: found the header 'temp_F', expected temp_C",
                          "s.csv:1: qx_rad: found the header 'qx_rad', expected qx"));
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad\n0,0\n", "RP"),
              ElementsAre("s.csv:1: q2_rad: found the header 'q2_rad', expected q2_mm or q2_m"));
}

TEST(SessionFaultsTest, NamesAJointThatTheRobotDoesNotHave) {
  EXPECT_THAT(
      FaultsIn("q0_rad,q1_rad,q2_rad,q3_rad\n0,0,0,0\n"),
      ElementsAre("s.csv:1: q0_rad: found the header 'q0_rad', expected a joint from 1 to 2, "
                  "as many as the robot has",
                  "s.csv:1: q3_rad: found the header 'q3_rad', expected a joint from 1 to 2, "
                  "as many as the robot has"));
}

// Catches: the second of two columns that wins in silence.
TEST(SessionFaultsTest, NamesColumnsThatStandTwice) {
  EXPECT_THAT(FaultsIn("q1_rad,q1_deg,q2_rad,note,note,\n0,0,0,0,0,0\n"),
              ElementsAre("s.csv:1: q1_deg: found a second column of q1, expected only q1_rad",
                          "s.csv:1: note: found a second column of that name, expected one",
                          "s.csv:1: column 6: found no name, expected a name"));
}

TEST(SessionFaultsTest, NamesWhatIsNoNumber) {
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad,temp_C\n"
                       "0,nan,20\n"
                       "inf,0,\n"
                       "0,0,warm\n"),
              ElementsAre("s.csv:2: q2_rad: found 'nan', expected a number",
                          "s.csv:3: q1_rad: found 'inf', expected a number",
                          "s.csv:4: temp_C: found 'warm', expected a number"));
}

// Catches: a pose of which one coordinate is 0 because it was not measured.
TEST(SessionFaultsTest, NamesAPartlyEmptyGroup) {
  EXPECT_THAT(
      FaultsIn("q1_rad,q2_rad,x_mm,y_mm,z_mm,qx,qy,qz,qw\n0,0,,2,,0,0,0,1\n1,,,,,,,,\n"),
      ElementsAre("s.csv:2: x_mm: found an empty cell, expected a number, as y_mm has one",
                  "s.csv:2: z_mm: found an empty cell, expected a number, as y_mm has one",
                  "s.csv:3: q2_rad: found an empty cell, expected a number, as q1_rad has one"));
}

TEST(SessionFaultsTest, NamesARowWithoutJoints) {
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad,x_mm,y_mm,z_mm\n,,1,2,3\n"),
              ElementsAre("s.csv:2: q1_rad: found no joint in this row, expected measured or "
                          "commanded joints"));
}

TEST(SessionFaultsTest, NamesRaggedRows) {
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad\n0,0,\n0\n"),
              ElementsAre("s.csv:2: found 3 cells, expected 2 as in the header",
                          "s.csv:3: found 1 cells, expected 2 as in the header"));
}

TEST(SessionFaultsTest, NamesWhatIsNoUnitVectorOrDeviation) {
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad,qx,qy,qz,qw\n0,0,0,0,0,0.99\n"),
              ElementsAre("s.csv:2: qx,qy,qz,qw: found a length of 0.99, expected 1 within 0.001"));
  EXPECT_THAT(
      FaultsIn("q1_rad,q2_rad,axis_x,axis_y,axis_z\n0,0,0,0,2\n"),
      ElementsAre("s.csv:2: axis_x,axis_y,axis_z: found a length of 2, expected 1 within 0.001"));
  EXPECT_THAT(
      FaultsIn("q1_rad,q2_rad,sx_mm,sy_mm,sz_mm\n0,0,0.1,-0.1,0\n"),
      ElementsAre("s.csv:2: sy_mm: found '-0.1', expected a standard deviation, at least 0"));
}

// Catches: a time without its offset, which is another instant in another plant.
TEST(SessionFaultsTest, NamesATimeThatIsNoInstant) {
  for (const char* time :
       {"2025-03-14T09:26:53", "14.03.2025 09:26", "infinite-future", "2025-13-14T09:26:53Z"}) {
    EXPECT_THAT(FaultsIn(std::string("q1_rad,q2_rad,time\n0,0,") + time + "\n"),
                ElementsAre("s.csv:2: time: found '" + std::string(time) +
                            "', expected ISO 8601 with offset, such as 2025-03-14T09:26:53+01:00"));
  }
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad,time\n0,0,2025-03-14T09:26:53Z\n"), IsEmpty());
}

// Catches: reading that stops at the first kind of fault: header, ragged rows and cells come
// together.
TEST(SessionFaultsTest, GathersAllFaultsOfAFile) {
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad,x,y_mm,z_mm\n0,0,1,2\nabc,0,1,2,3\n0,0,nan,2,zz\n"),
              ElementsAre("s.csv:2: found 4 cells, expected 5 as in the header",
                          "s.csv:1: x: found the header 'x', expected x_mm or x_m",
                          "s.csv:3: q1_rad: found 'abc', expected a number",
                          "s.csv:4: x: found 'nan', expected a number",
                          "s.csv:4: z_mm: found 'zz', expected a number"));
}

TEST(SessionFaultsTest, NamesAFileWithoutReadings) {
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad\n"),
              ElementsAre("s.csv: found no rows under the header, expected at least one reading"));
  EXPECT_THAT(FaultsIn(""), ElementsAre("s.csv: found no text, expected a header line"));
}

// Catches: memory filled with faults of a file of the wrong kind.
TEST(SessionFaultsTest, StopsAfterManyFaults) {
  std::string text = "q1_rad,q2_rad\n";
  for (int i = 0; i < 30000; ++i) text += "a,b" + std::to_string(i) + "\n";
  const auto result = ParseSessionFile(text, "s.csv", RobotOf("RR"));
  EXPECT_THAT(Faults(result), SizeIs(200));
  EXPECT_THAT(std::string(result.status().message()), ::testing::EndsWith("and 9800 more"));
}

// Catches: a robot without joints that breaks the reader.
TEST(SessionFaultsTest, SurvivesARobotWithoutJoints) {
  EXPECT_THAT(FaultsIn("x_mm,y_mm,z_mm\n1,2,3\n", ""),
              ElementsAre("s.csv:1: found no column of a joint, expected those of a robot with "
                          "joints, or those of a robot with joints"));
}

}  // namespace
}  // namespace truepose::formats
