// Thousands of damaged files: reading ends with a result or with faults, and a result that is
// written reads back. Catches: a crash, an abort, an endless loop, an error without a fault; under
// sanitizers every bad access.
#include <algorithm>
#include <cmath>
#include <random>

#include "core/base/fault.h"
#include "formats/fixture_file.h"
#include "formats/robot_file.h"
#include "formats/session_file.h"
#include "formats/targets_file.h"
#include "formats/ur_calibration.h"
#include "formats/urdf.h"
#include "gtest/gtest.h"
#include "tests/formats/damage.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

constexpr int kCases = 20000;

constexpr char kSession[] =
    "time;placement;target;q1_deg;q2_mm;q1_cmd_deg;q2_cmd_mm;x_mm;y_mm;z_mm;qx;qy;qz;qw;rx_deg;ry_"
    "deg;rz_deg;"
    "sx_mm;sy_mm;sz_mm;axis_x;axis_y;axis_z;temp_C;tau1_Nm;tau2_Nm;note\r\n"
    "2025-03-14T09:26:53Z;a;\"T;\"\"1\"\"\";1,5;250;1,5;250;1;2;3;0;0;0;1;0;0;0;0,1;0,1;0,1;0;0;1;"
    "20;1;2;x\r\n"
    "2025-03-14T09:26:54Z;a;T;2,5;251;;;;;;0;0;0,6;0,8;;;;;;;;;;;;;\r\n"
    ";;;3,5;252;3;252;1;2;3;;;;;;;;;;;;;;;;;\xC3\xBC\r\n";

constexpr char kTargets[] =
    "name,q1_rad,q2_m,x_mm,y_mm,z_mm,qx,qy,qz,qw\nhome,0.1,0.2,1,2,3,0,0,0,1\n\"p,2\",,,1e2,-2,+3,"
    "0.6,0,0,-0.8\n";

constexpr char kRobot[] =
    "# a robot\nrobot: r-1\nserial: \"01\"\nkind: industrial\n"
    "joints:\n  - {name: turn, type: revolute, lower_deg: -90, upper_rad: 2}\n"
    "  - name: slide\n    type: prismatic\n    upper_mm: 650\n"
    "geometry:\n  chain: [{tz_mm: 127.3}, {rz_joint: turn}, {rx_deg: -90}, {tz_joint: 2}]\n"
    "  flange:\n    - {tz_mm: 107}\n"
    "joint_map: {scale: [[1, 0], [0.5, -1]], offset_deg: [90, 0], offset_mm: [0, 12]}\n"
    "tools:\n  pin: {z_mm: 161}\n  'the hand': {x_mm: 1, qx: 0, qy: 0, qz: 0.8, qw: 0.6}\n"
    "masses:\n  - {joint: slide, mass_kg: 5.1, center_mm: [0, 1, 300]}\n";

constexpr char kFixture[] =
    "name: dime\nfeatures:\n"
    "  - {name: 1, kind: point, position_mm: [1, 2, 3], sd_mm: [0.02, 0, 0.1]}\n"
    "  - {name: hole, kind: point_axis, position_m: [0, 0, 1], axis: [0, 0.6, 0.8], sd_deg: 0.1}\n"
    "  - name: seat\n    kind: pose\n    position_mm: [4, 5, 6]\n    rpy_deg: [90, 0, -45]\n"
    "    covariance_mm_deg: [[4, 1, 0, 0, 0, 0], [1, 4, 0, 0, 0, 0], [0, 0, 4, 0, 0, 0],\n"
    "      [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0.5], [0, 0, 0, 0, 0.5, 1]]\n"
    "  - {name: top, kind: plane, position_mm: [0, 0, 40], qx: 0, qy: 0, qz: 0.8, qw: -0.6}\n";

constexpr char kDh[] =
    "robot: r\njoints: [{name: a, type: revolute}]\n"
    "geometry: {standard_dh: [{theta_deg: 0, d_mm: 1, a_mm: 0, alpha_deg: 90}]}\n";

constexpr char kUrdf[] =
    "<?xml version='1.0'?>\n<robot name=\"r\"><!-- <a> -->\n"
    "<link name=\"a\"/><link name=\"b\"><inertial><origin xyz=\"0 0 1\"/><mass value=\"2\"/>"
    "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial></link>"
    "<link name=\"c\"/>\n<joint name=\"i\" type=\"revolute\"><parent link=\"a\"/><child "
    "link=\"b\"/>"
    "<origin xyz=\"1 2 3\" rpy=\"0.1 1.5707963 0\"/><axis xyz=\"0 0.6 0.8\"/>"
    "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>\n"
    "<joint name=\"j\" type=\"continuous\"><parent link=\"b\"/><child "
    "link=\"c\"/></joint></robot>\n";

constexpr char kUrCalibration[] =
    "kinematics:\n  shoulder: &s {x: 0, y: 0, z: 0.1, roll: 0, pitch: 0, yaw: 0}\n"
    "  upper_arm: {x: 0, y: 0, z: 0, roll: 1.57, pitch: 0, yaw: 0}\n"
    "  forearm: {x: -0.6, y: 0, z: 0, roll: 0, pitch: 0, yaw: 0}\n"
    "  wrist_1: {x: -0.5, y: 0, z: 0.1, roll: 0, pitch: 0, yaw: 0}\n"
    "  wrist_2: {x: 0, y: -0.1, z: 0, roll: 1.57, pitch: 0, yaw: 0}\n"
    "  wrist_3: {x: 0, y: 0.09, z: 0, roll: -1.57, pitch: 0, yaw: 0}\n  hash: calib_1\n";

constexpr testing::DamageManner kManner{
    .likely = "\",;:\n\r\t {}[]-#&*?!|>'%@`~0123456789.eE+nqxyz_\xEF\xC3\xFF"};

// Every way a reader may end: a value, or kInvalidArgument with at least one fault whose parts are
// text.
template <class T>
bool IsValueOrFaults(const absl::StatusOr<T>& result, const std::string& text) {
  if (result.ok()) return true;
  EXPECT_EQ(result.status().code(), absl::StatusCode::kInvalidArgument) << text;
  EXPECT_FALSE(FaultsOf(result.status()).empty()) << text;
  for (const Fault& fault : FaultsOf(result.status())) {
    EXPECT_FALSE(fault.field.empty() || fault.found.empty()) << text << "\n" << result.status();
  }
  return false;
}

TEST(MutationTest, Sessions) {
  const v1::Nominal robot = RobotOf("RP");
  const SessionFileOptions options{.euler = "xyz-intrinsic"};
  ASSERT_TRUE(ParseSessionFile(kSession, "s.csv", robot, options).ok());
  testing::Mutator mutator(1, kManner);
  int read = 0;
  for (int i = 0; i < kCases && !HasFailure(); ++i) {
    const std::string text = mutator.Damage(kSession);
    const auto result = ParseSessionFile(text, "s.csv", robot, options);
    if (!IsValueOrFaults(result, text)) continue;
    ++read;
    const std::string written = WriteSessionFile(robot, result->session, result->readings);
    const auto again = ParseSessionFile(written, "s.csv", robot);
    ASSERT_TRUE(again.ok()) << text << written << again.status();
  }
  // A mutator that leaves nothing whole, or all of it, would test only one of the ways.
  EXPECT_GT(read, kCases / 50);
  EXPECT_LT(read, kCases / 2);
}

constexpr char kFurther[] =
    "q1_deg,q2_mm,x_mm,z_mm,sx_mm,sz_mm,p1_x_mm,p1_y_mm,p1_z_mm,p1_sx_mm,p1_sy_mm,p1_sz_mm,p3_x_m,"
    "p3_y_m,p3_z_m,distance_mm,distance_sd_m,anchor,beam,feature\n"
    "1,2,3,4,0.1,0.2,5,6,7,0.1,0.1,0.1,1,2,3,500,0.001,A,,\n"
    "2,3,,4,,0.2,,,,,,,1,2,3,-5,,A,b1,f\n3,4,,,,,,,,,,,,,,,,,,f\n";

// The columns that most files do not have.
TEST(MutationTest, FurtherMeasurements) {
  const v1::Nominal robot = RobotOf("RP");
  ASSERT_TRUE(ParseSessionFile(kFurther, "s.csv", robot).ok());
  testing::Mutator mutator(6, kManner);
  int read = 0;
  for (int i = 0; i < kCases && !HasFailure(); ++i) {
    const std::string text = mutator.Damage(kFurther);
    const auto result = ParseSessionFile(text, "s.csv", robot);
    if (!IsValueOrFaults(result, text)) continue;
    ++read;
    const std::string written = WriteSessionFile(robot, result->session, result->readings);
    const auto again = ParseSessionFile(written, "s.csv", robot);
    ASSERT_TRUE(again.ok()) << text << written << again.status();
    ASSERT_EQ(WriteSessionFile(robot, again->session, again->readings), written) << text;
  }
  EXPECT_GT(read, kCases / 50);
  EXPECT_LT(read, kCases / 2);
}

TEST(MutationTest, Fixtures) {
  ASSERT_TRUE(ParseFixtureFile(kFixture, "f.yaml").ok());
  testing::Mutator mutator(7, kManner);
  int read = 0;
  for (int i = 0; i < kCases && !HasFailure(); ++i) {
    const std::string text = mutator.Damage(kFixture);
    const auto result = ParseFixtureFile(text, "f.yaml");
    if (!IsValueOrFaults(result, text)) continue;
    ++read;
    const std::string written = WriteFixtureFile(result->fixture);
    const auto again = ParseFixtureFile(written, "f.yaml");
    ASSERT_TRUE(again.ok()) << text << "\n" << written << again.status();
    ASSERT_EQ(WriteFixtureFile(again->fixture), written) << text;
  }
  EXPECT_GT(read, kCases / 200);
  EXPECT_LT(read, kCases / 2);
}

TEST(MutationTest, Targets) {
  const v1::Nominal robot = RobotOf("RP");
  ASSERT_TRUE(ParseTargetsFile(kTargets, "t.csv", robot).ok());
  testing::Mutator mutator(2, kManner);
  int read = 0;
  for (int i = 0; i < kCases && !HasFailure(); ++i) {
    const std::string text = mutator.Damage(kTargets);
    read += IsValueOrFaults(ParseTargetsFile(text, "t.csv", robot), text);
  }
  EXPECT_GT(read, kCases / 50);
  EXPECT_LT(read, kCases * 3 / 4);
}

void CheckRobots(const std::string& valid, uint64_t seed, int cases) {
  ASSERT_TRUE(ParseRobotFile(valid, "r.yaml").ok());
  testing::Mutator mutator(seed, kManner);
  int read = 0;
  for (int i = 0; i < cases && !::testing::Test::HasFailure(); ++i) {
    const std::string text = mutator.Damage(valid);
    const auto result = ParseRobotFile(text, "r.yaml");
    if (!IsValueOrFaults(result, text)) continue;
    ++read;
    const auto again = ParseRobotFile(WriteRobotFile(*result), "r.yaml");
    ASSERT_TRUE(again.ok()) << text << "\n" << WriteRobotFile(*result) << again.status();
  }
  EXPECT_GT(read, cases / 200);
  EXPECT_LT(read, cases / 2);
}

TEST(MutationTest, Robots) { CheckRobots(kRobot, 3, kCases); }

TEST(MutationTest, DhTables) { CheckRobots(kDh, 4, kCases); }

// What is read is a chain of finite numbers: also catches an end of the process in the XML library.
TEST(MutationTest, Urdf) {
  ASSERT_TRUE(ParseUrdf(kUrdf, "r.urdf", {}).ok());
  testing::Mutator mutator(6, kManner);
  int read = 0;
  for (int i = 0; i < kCases && !HasFailure(); ++i) {
    const std::string text = mutator.Damage(kUrdf);
    const auto result = ParseUrdf(text, "r.urdf", {});
    if (!IsValueOrFaults(result, text)) continue;
    ++read;
    for (const auto& element : result->nominal.geometry().chain().elements())
      ASSERT_TRUE(std::isfinite(element.constant())) << text;
  }
  EXPECT_GT(read, kCases / 50);
  EXPECT_LT(read, kCases * 3 / 4);
}

TEST(MutationTest, UrCalibrations) {
  ASSERT_TRUE(ParseUrCalibration(kUrCalibration, "ur.yaml").ok());
  testing::Mutator mutator(7, kManner);
  int read = 0;
  for (int i = 0; i < kCases && !HasFailure(); ++i) {
    const std::string text = mutator.Damage(kUrCalibration);
    const auto result = ParseUrCalibration(text, "ur.yaml");
    if (!IsValueOrFaults(result, text)) continue;
    ++read;
    const auto again = ParseUrCalibration(ValueOf(WriteUrCalibration(*result)), "ur.yaml");
    ASSERT_TRUE(again.ok()) << text << again.status();
  }
  EXPECT_GT(read, kCases / 100);
  EXPECT_LT(read, kCases * 3 / 4);
}

// Bytes without any form, short and long.
TEST(MutationTest, Noise) {
  std::mt19937_64 random(5);
  const v1::Nominal robot = RobotOf("RP");
  for (int i = 0; i < kCases; ++i) {
    std::string text(random() % 200, '\0');
    for (char& c : text) c = static_cast<char>(i % 2 == 0 ? random() : 32 + random() % 95);
    IsValueOrFaults(ParseRobotFile(text, "r.yaml"), text);
    IsValueOrFaults(ParseFixtureFile(text, "f.yaml"), text);
    IsValueOrFaults(ParseUrdf(text, "r.urdf", {}), text);
    IsValueOrFaults(ParseSessionFile(text, "s.csv", robot), text);
    IsValueOrFaults(ParseTargetsFile(text, "t.csv", robot), text);
  }
}

}  // namespace
}  // namespace truepose::formats
