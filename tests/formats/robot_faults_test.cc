// Every fault of a robot file, word by word.
#include "formats/robot_file.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> FaultsIn(const std::string& text) {
  return Faults(ParseRobotFile(text, "r.yaml"));
}

// A robot of one joint, whose lines a test can replace.
struct Lines {
  std::string robot = "robot: r";
  std::string joints = "joints: [{name: a, type: revolute}]";
  std::string geometry = "geometry: {chain: [{rz_joint: 1}]}";
  std::string more = "";

  std::string Text() const { return robot + "\n" + joints + "\n" + geometry + "\n" + more + "\n"; }
};

// Catches: a sample that is at fault itself, which would make every other test here meaningless.
TEST(RobotFaultsTest, TheSampleHasNone) { EXPECT_THAT(FaultsIn(Lines().Text()), IsEmpty()); }

TEST(RobotFaultsTest, NamesUnknownKeysWithTheNearestKnownOne) {
  EXPECT_THAT(
      FaultsIn(Lines{.more = "seriel: x\npayload: 3"}.Text()),
      ElementsAre("r.yaml:4: 'seriel': found an unknown key, expected serial",
                  "r.yaml:5: 'payload': found an unknown key, expected robot, serial, "
                  "manufacturer, model, kind, joints, geometry, joint_map, tools or masses"));
  EXPECT_THAT(FaultsIn(Lines{.joints = "joints: [{nme: a, type: revolute, name: a}]"}.Text()),
              ElementsAre("r.yaml:2: joints[0].'nme': found an unknown key, expected name"));
}

TEST(RobotFaultsTest, NamesMissingKeys) {
  EXPECT_THAT(FaultsIn("kind: measuring\n"),
              ElementsAre("r.yaml:1: robot: found no such key, expected one",
                          "r.yaml:1: joints: found no such key, expected one",
                          "r.yaml:1: geometry: found no such key, expected one"));
  EXPECT_THAT(FaultsIn(Lines{.joints = "joints:\n  - {name: a}"}.Text()),
              ElementsAre("r.yaml:3: joints[0].type: found no such key, expected one"));
}

// Catches: a file of another kind, or none, that breaks the reader.
TEST(RobotFaultsTest, NamesWhatIsNoMap) {
  EXPECT_THAT(FaultsIn(""), ElementsAre("r.yaml:1: found nothing, expected a map of `key: value`"));
  EXPECT_THAT(FaultsIn("q1_rad,q2_rad\n0,0\n"),
              ElementsAre("r.yaml:1: found 'q1_rad,q2_rad 0,0', expected a map of `key: value`"));
  EXPECT_THAT(FaultsIn(Lines{.joints = "joints: {a: 1}", .geometry = "geometry: 3"}.Text()),
              ElementsAre("r.yaml:2: joints: found a map, expected a list",
                          "r.yaml:3: geometry: found '3', expected a map of `key: value`"));
}

TEST(RobotFaultsTest, NamesWrongTexts) {
  EXPECT_THAT(
      FaultsIn(Lines{.robot = "robot: UR 10"}.Text()),
      ElementsAre("r.yaml:1: robot: found 'UR 10', expected lower-case letters, digits and -, "
                  "at most 63, not - first"));
  EXPECT_THAT(
      FaultsIn(Lines{.joints = "joints: [{name: a, type: rotary}]"}.Text()),
      ElementsAre("r.yaml:2: joints[0].type: found 'rotary', expected revolute or prismatic"));
  EXPECT_THAT(FaultsIn(Lines{.more = "kind: mobile\nserial: [1]"}.Text()),
              ElementsAre("r.yaml:5: serial: found a list of 1, expected a text",
                          "r.yaml:4: kind: found 'mobile', expected industrial or measuring"));
}

// Catches: a length or angle without its unit that is taken as mm, deg or SI.
TEST(RobotFaultsTest, NamesMissingAndWrongUnits) {
  EXPECT_THAT(
      FaultsIn(Lines{
          .joints = "joints: [{name: a, type: revolute, lower: -1, upper_mm: 3}]",
          .geometry = "geometry: {standard_dh: [{theta: 0, d_in: 1, a_mm: 0, alpha_deg: 90}]}"}
                   .Text()),
      ElementsAre(
          "r.yaml:2: joints[0].lower: found the key 'lower', expected lower_deg or lower_rad",
          "r.yaml:2: joints[0].upper_mm: found the key 'upper_mm', expected upper_deg or upper_rad",
          "r.yaml:3: geometry.standard_dh[0].theta: found the key 'theta', expected theta_deg or "
          "theta_rad",
          "r.yaml:3: geometry.standard_dh[0].d_in: found the key 'd_in', expected d_mm or d_m"));
  EXPECT_THAT(FaultsIn(Lines{.more = "tools: {pin: {z: 161}}"}.Text()),
              ElementsAre("r.yaml:4: tools.pin.z: found the key 'z', expected z_mm or z_m"));
}

TEST(RobotFaultsTest, NamesAMissingMeasureAndTwoOfOne) {
  EXPECT_THAT(
      FaultsIn(
          Lines{.geometry = "geometry: {standard_dh: [{theta_deg: 0, d_mm: 1, d_m: 1, a_mm: 0}]}"}
              .Text()),
      ElementsAre("r.yaml:3: geometry.standard_dh[0].d_m: found a second value beside d_mm, "
                  "expected one of them",
                  "r.yaml:3: geometry.standard_dh[0].alpha_deg: found no such key, expected "
                  "alpha_deg or alpha_rad"));
}

TEST(RobotFaultsTest, NamesWhatIsNoNumber) {
  EXPECT_THAT(
      FaultsIn(Lines{.geometry = "geometry: {chain: [{rz_joint: 1}, {tz_mm: long}, {rx_deg: .nan}, "
                                 "{tx_mm: [1]}, {ty_mm: }]}"}
                   .Text()),
      ElementsAre("r.yaml:3: geometry.chain[1].tz_mm: found 'long', expected a number",
                  "r.yaml:3: geometry.chain[2].rx_deg: found '.nan', expected a number",
                  "r.yaml:3: geometry.chain[3].tx_mm: found a list of 1, expected a number",
                  "r.yaml:3: geometry.chain[4].ty_mm: found nothing, expected a number"));
}

TEST(RobotFaultsTest, NamesAJointCountThatDoesNotMatch) {
  EXPECT_THAT(
      FaultsIn(Lines{
          .joints = "joints: [{name: a, type: revolute}, {name: b, type: revolute}]",
          .geometry = "geometry:\n  craig_dh: [{theta_deg: 0, d_mm: 0, a_mm: 0, alpha_deg: 0}]"}
                   .Text()),
      ElementsAre(
          "r.yaml:4: geometry.craig_dh: found 1 rows, expected 2, one for each of the joints"));
  EXPECT_THAT(
      FaultsIn(
          Lines{.joints = "joints: [{name: a, type: revolute}, {name: b, type: revolute}]"}.Text()),
      ElementsAre("r.yaml:3: geometry.chain: found no element of joint 2, 'b', expected 2, one for "
                  "each of the joints"));
}

TEST(RobotFaultsTest, NamesDuplicates) {
  EXPECT_THAT(
      FaultsIn(
          Lines{.joints = "joints:\n  - {name: a, type: revolute}\n  - {name: a, type: revolute}",
                .geometry = "geometry: {chain: [{rz_joint: 1}, {ry_joint: 2}]}",
                .more = "tools: {t: {z_mm: 1}, t: {z_mm: 2}}\nrobot: s"}
              .Text()),
      ElementsAre("r.yaml:7: 'robot': found the key a second time, expected one",
                  "r.yaml:4: joints[1].name: found 'a' a second time, expected a name other than "
                  "that of joints[0]",
                  "r.yaml:6: tools.'t': found the key a second time, expected one"));
}

// Catches: a joint that moves two elements or none, a revolute joint that translates.
TEST(RobotFaultsTest, NamesWrongJointsOfAChain) {
  EXPECT_THAT(
      FaultsIn(Lines{.geometry = "geometry: {chain: [{rz_joint: 1}, {ry_joint: a}]}"}.Text()),
      ElementsAre(
          "r.yaml:3: geometry.chain[1].ry_joint: found joint 'a' a second time, expected each "
          "joint once"));
  EXPECT_THAT(
      FaultsIn(Lines{.geometry = "geometry: {chain: [{tz_joint: 1}]}"}.Text()),
      ElementsAre(
          "r.yaml:3: geometry.chain[0].tz_joint: found revolute joint '1', expected rx_joint, "
          "ry_joint or rz_joint"));
  EXPECT_THAT(
      FaultsIn(Lines{.geometry = "geometry: {chain: [{rz_joint: 1}, {rz_joint: 2}, {rz_joint: 0}, "
                                 "{rz_joint: elbow}]}"}
                   .Text()),
      ElementsAre(
          "r.yaml:3: geometry.chain[1].rz_joint: found '2', expected the name of a joint or "
          "its number, 1 to 1",
          "r.yaml:3: geometry.chain[2].rz_joint: found '0', expected the name of a joint or "
          "its number, 1 to 1",
          "r.yaml:3: geometry.chain[3].rz_joint: found 'elbow', expected the name of a joint "
          "or its number, 1 to 1"));
}

TEST(RobotFaultsTest, NamesElementsThatAreNotOneTransform) {
  EXPECT_THAT(
      FaultsIn(Lines{.geometry = "geometry: {chain: [{rz_joint: 1}, {tz_mm: 1, rx_deg: 2}, {}], "
                                 "flange: [{rz_joint: 1}]}"}
                   .Text()),
      ElementsAre(
          "r.yaml:3: geometry.chain[1]: found 2 transforms, expected one, such as {tz_mm: 127.3}",
          "r.yaml:3: geometry.chain[2]: found 0 transforms, expected one, such as {tz_mm: 127.3}",
          "r.yaml:3: geometry.flange[0].rz_joint: found the key 'rz_joint', expected rz_deg or "
          "rz_rad"));
}

TEST(RobotFaultsTest, NamesGeometriesThatAreNoneOrTwo) {
  EXPECT_THAT(
      FaultsIn(Lines{.geometry = "geometry: {flange: []}"}.Text()),
      ElementsAre(
          "r.yaml:3: geometry: found 0 of standard_dh, craig_dh and chain, expected one of them"));
  EXPECT_THAT(
      FaultsIn(Lines{.geometry =
                         "geometry: {chain: [{rz_joint: 1}], standard_dh: [{theta_deg: 0, d_mm: 0, "
                         "a_mm: 0, alpha_deg: 0}]}"}
                   .Text()),
      ElementsAre(
          "r.yaml:3: geometry: found 2 of standard_dh, craig_dh and chain, expected one of them"));
}

TEST(RobotFaultsTest, NamesLimitsInTheWrongOrder) {
  EXPECT_THAT(
      FaultsIn(Lines{.joints = "joints: [{name: a, type: revolute, lower_deg: 90, upper_rad: 1}]"}
                   .Text()),
      ElementsAre(
          "r.yaml:2: joints[0].upper: found a limit not above the lower one, expected lower < "
          "upper"));
}

TEST(RobotFaultsTest, NamesJointMapsOfAnotherSize) {
  EXPECT_THAT(
      FaultsIn(Lines{
          .more =
              "joint_map: {scale: [[1, x], [1]], offset_deg: [1, 2], offset_mm: [3], offset: [1]}"}
                   .Text()),
      ElementsAre(
          "r.yaml:4: joint_map.scale[0][1]: found 'x', expected a number",
          "r.yaml:4: joint_map.scale[0]: found 2 numbers, expected 1, as many as joints",
          "r.yaml:4: joint_map.scale: found 2 rows, expected 1, as many as joints",
          "r.yaml:4: joint_map.offset: found the key 'offset', expected offset_deg or offset_rad",
          "r.yaml:4: joint_map.offset_mm[0]: found 3, expected 0: joint 1 is revolute"));
}

TEST(RobotFaultsTest, NamesQuaternionsThatAreNone) {
  EXPECT_THAT(
      FaultsIn(Lines{
          .more =
              "tools:\n  a: {qx: 0, qw: 1}\n  b: {qx: 0, qy: 0, qz: 0, qw: 2}\n  c: {rx_deg: 3}"}
                   .Text()),
      ElementsAre(
          "r.yaml:5: tools.a: found 2 of qx, qy, qz, qw, expected all four or none",
          "r.yaml:6: tools.b.qx,qy,qz,qw: found a length of 2, expected 1 within 0.001",
          "r.yaml:7: tools.c.'rx_deg': found an unknown key, expected x_mm, x_m, y_mm, y_m, "
          "z_mm, z_m, qx, qy, qz or qw"));
}

// Catches: memory that grows with the square of the joints of a hostile file.
TEST(RobotFaultsTest, NamesTooManyJoints) {
  std::string joints = "joints:\n";
  for (int i = 0; i < 65; ++i) joints += "  - {name: j" + std::to_string(i) + ", type: revolute}\n";
  EXPECT_THAT(FaultsIn(Lines{.joints = joints, .more = "joint_map: {}"}.Text()),
              ElementsAre("r.yaml:2: joints: found 65 joints, expected at most 64"));
}

// Catches: a mass that hangs on joint 0 because its name was not found, a centre taken in metres.
TEST(RobotFaultsTest, NamesFaultsOfMasses) {
  EXPECT_THAT(
      FaultsIn(Lines{.more = "masses:\n  - {joint: b, mass_kg: 1, center_mm: [1, 2, 3]}\n"
                             "  - {joint: 1, mass: 1, center_mm: [1, 2]}\n"
                             "  - {joint: a, mass_kg: -1, center_in: [1, 2, 3]}\n"
                             "  - {mass_kg: 1, mass_g: 2}\n  - 3"}
                   .Text()),
      ElementsAre(
          "r.yaml:5: masses[0].joint: found 'b', expected the name of a joint or its number, 1 to "
          "1",
          "r.yaml:6: masses[1].mass: found the key 'mass', expected mass_kg",
          "r.yaml:6: masses[1].center_mm: found 2 numbers, expected 3, x, y, z",
          "r.yaml:7: masses[2].mass_kg: found a negative mass, expected 0 or more",
          "r.yaml:7: masses[2].center_in: found the key 'center_in', expected center_mm or "
          "center_m",
          "r.yaml:8: masses[3].joint: found no such key, expected one",
          "r.yaml:8: masses[3].mass_g: found the key 'mass_g', expected mass_kg",
          "r.yaml:8: masses[3].center_mm: found no such key, expected center_mm or center_m",
          "r.yaml:9: masses[4]: found '3', expected a map of `key: value`"));
  EXPECT_THAT(FaultsIn(Lines{.more = "masses: {a: 1}"}.Text()),
              ElementsAre("r.yaml:4: masses: found a map, expected a list"));
}

}  // namespace
}  // namespace truepose::formats
