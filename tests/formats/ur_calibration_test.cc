// UR's calibration file: what is written reads back to the bit, and faults have their lines.
#include "formats/ur_calibration.h"

#include "formats/joint_origins.h"
#include "gmock/gmock.h"
#include "google/protobuf/util/message_differencer.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

UrCalibration Sample() {
  UrCalibration calibration{{}, "calib_12788084448423163542"};
  Elements* elements = calibration.geometry.mutable_chain()->mutable_elements();
  for (int i = 0; i < 6; ++i) {
    AppendOrigin({-0.612 - i, i / 3.0, 1e-5 * i, 1.57 / (i + 1), 0.001 * i, -0.002 * i}, elements);
    AppendJoint(v1::REVOLUTE, i, elements);
  }
  return calibration;
}

// Catches: digits that are cut, values or links in another order.
TEST(UrCalibrationTest, ReadsBackToTheBit) {
  const std::string text = ValueOf(WriteUrCalibration(Sample()));
  EXPECT_THAT(text, HasSubstr("kinematics:\n  shoulder:\n    x: -0.612\n    y: 0\n"));
  const UrCalibration read = ValueOf(ParseUrCalibration(text, "ur.yaml"));
  EXPECT_EQ(read.hash, Sample().hash);
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(read.geometry, Sample().geometry));
}

// The form in which UR's own extraction writes: would catch a reader of our own spelling only.
TEST(UrCalibrationTest, ReadsFlowStyleAndSignedZeros) {
  const std::string link = ": {x: -0, y: 0, z: 1e-3, roll: 1.570796327, pitch: 0, yaw: -0}\n";
  std::string text = "kinematics:\n";
  for (const char* name : {"shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"})
    text += std::string("  ") + name + link;
  const UrCalibration read = ValueOf(ParseUrCalibration(text + "  hash: calib_1\n", "ur.yaml"));
  EXPECT_EQ(ValueOf(JointOriginsOf(read.geometry)).at(3).z, 1e-3);
}

TEST(UrCalibrationTest, NamesFaultsWithLines) {
  EXPECT_THAT(Faults(ParseUrCalibration("kinematics:\n  shoulder: {x: 0, y: 0, z: no, roll: 0, "
                                        "pitch: 0, yaw: 0, w: 1}\n  hash: h\n",
                                        "ur.yaml")),
              ElementsAre(HasSubstr("ur.yaml:2: kinematics.shoulder.z: found 'no', expected a "),
                          HasSubstr("ur.yaml:2: kinematics.shoulder.'w': found an unknown key"),
                          HasSubstr("kinematics.upper_arm: found no such key"),
                          HasSubstr("kinematics.forearm: found no such key"),
                          HasSubstr("kinematics.wrist_1: found no such key"),
                          HasSubstr("kinematics.wrist_2: found no such key"),
                          HasSubstr("kinematics.wrist_3: found no such key")));
  EXPECT_FALSE(ParseUrCalibration("robot: r\n", "ur.yaml").ok());
  EXPECT_FALSE(ParseUrCalibration("[", "ur.yaml").ok());
}

// Catches: a seventh joint or a flange that silently goes missing.
TEST(UrCalibrationTest, RefusesOtherGeometries) {
  UrCalibration flanged = Sample();
  AppendOrigin({0, 0, 0.1, 0, 0, 0}, flanged.geometry.mutable_chain()->mutable_elements());
  EXPECT_FALSE(WriteUrCalibration(flanged).ok());
  UrCalibration longer = Sample();
  AppendJoint(v1::REVOLUTE, 6, longer.geometry.mutable_chain()->mutable_elements());
  EXPECT_FALSE(WriteUrCalibration(longer).ok());
}

}  // namespace
}  // namespace truepose::formats
