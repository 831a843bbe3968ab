#include "formats/robot_file.h"

#include <cmath>
#include <numbers>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;
using Element = v1::ElementaryTransform;

RobotFile Parse(const std::string& text) { return ValueOf(ParseRobotFile(text, "r.yaml")); }

constexpr char kTwoJoints[] =
    "robot: r-2\n"
    "joints:\n"
    "  - {name: turn, type: revolute, lower_deg: -90, upper_rad: 2}\n"
    "  - name: slide\n"
    "    type: prismatic\n"
    "    upper_mm: 650\n";

TEST(RobotFileTest, ReadsIdentityAndJoints) {
  const RobotFile file =
      Parse("serial: 0123\nmanufacturer: \"M & Co\"\nmodel: X\nkind: measuring\n" +
            std::string(kTwoJoints) + "geometry: {chain: [{rz_joint: turn}, {tx_joint: 2}]}\n");
  const v1::Nominal& nominal = file.nominal;
  EXPECT_EQ(file.robot_id, "r-2");
  EXPECT_EQ(nominal.serial(), "0123");
  EXPECT_EQ(nominal.manufacturer(), "M & Co");
  EXPECT_EQ(nominal.kind(), v1::MEASURING);
  ASSERT_EQ(nominal.joints_size(), 2);
  EXPECT_EQ(nominal.joints(0).lower(), -std::numbers::pi / 2);
  EXPECT_EQ(nominal.joints(0).upper(), 2);
  EXPECT_EQ(nominal.joints(1).name(), "slide");
  EXPECT_EQ(nominal.joints(1).type(), v1::PRISMATIC);
  EXPECT_FALSE(nominal.joints(1).has_lower());
  EXPECT_EQ(nominal.joints(1).upper(), 0.65);
  EXPECT_FALSE(nominal.has_joint_map());
}

// Catches: d and a exchanged, standard taken for Craig, degrees taken for radians.
TEST(RobotFileTest, ReadsBothDhTables) {
  const std::string rows =
      "    - {theta_deg: 45, d_mm: 127.3, a_mm: -612, alpha_deg: 90}\n"
      "    - {theta_rad: 0, d_m: 1, a_m: 2, alpha_rad: 3}\n";
  const RobotFile standard = Parse(kTwoJoints + ("geometry:\n  standard_dh:\n" + rows));
  const auto& table = standard.nominal.geometry().standard_dh();
  ASSERT_EQ(table.rows_size(), 2);
  EXPECT_EQ(table.rows(0).theta_rad(), std::numbers::pi / 4);
  EXPECT_EQ(table.rows(0).d_m(), 0.1273);
  EXPECT_EQ(table.rows(0).a_m(), -0.612);
  EXPECT_EQ(table.rows(0).alpha_rad(), std::numbers::pi / 2);
  EXPECT_EQ(table.rows(1).alpha_rad(), 3);
  EXPECT_EQ(standard.nominal.kind(), v1::INDUSTRIAL);
  const RobotFile craig = Parse(kTwoJoints + ("geometry:\n  craig_dh:\n" + rows));
  EXPECT_EQ(craig.nominal.geometry().craig_dh().rows_size(), 2);
}

// Catches: joints that count from 1 in the file and land on the next joint, a flange that is lost.
TEST(RobotFileTest, ReadsAChainAndAFlange) {
  const RobotFile file = Parse(kTwoJoints + std::string("geometry:\n"
                                                        "  chain:\n"
                                                        "    - {tz_mm: 127.3}\n"
                                                        "    - {rz_joint: 1, rz_deg: 90}\n"
                                                        "    - {rx_deg: -90}\n"
                                                        "    - {ty_joint: slide}\n"
                                                        "  flange: [{tz_mm: 107}]\n"));
  const v1::Geometry& geometry = file.nominal.geometry();
  ASSERT_EQ(geometry.chain().elements_size(), 4);
  const auto& elements = geometry.chain().elements();
  EXPECT_EQ(elements[0].motion(), Element::TRANSLATION);
  EXPECT_EQ(elements[0].axis(), v1::Z);
  EXPECT_EQ(elements[0].constant(), 0.1273);
  EXPECT_FALSE(elements[0].has_joint());
  EXPECT_EQ(elements[1].motion(), Element::ROTATION);
  EXPECT_EQ(elements[1].joint(), 0);
  EXPECT_EQ(elements[1].constant(), std::numbers::pi / 2);
  EXPECT_EQ(elements[2].axis(), v1::X);
  EXPECT_EQ(elements[3].axis(), v1::Y);
  EXPECT_EQ(elements[3].joint(), 1);
  ASSERT_EQ(geometry.flange_size(), 1);
  EXPECT_EQ(geometry.flange(0).constant(), 0.107);
}

constexpr char kChain[] = "geometry: {chain: [{rz_joint: 1}, {tx_joint: 2}]}\n";

// Catches: a matrix read column by column, an offset with the other type's unit.
TEST(RobotFileTest, ReadsTheJointMap) {
  const RobotFile file = Parse(std::string(kTwoJoints) + kChain +
                               "joint_map:\n  scale: [[1, 0], [0.5, -1]]\n  offset_deg: [90, 0]\n"
                               "  offset_mm: [0, 12]\n");
  EXPECT_THAT(file.nominal.joint_map().scale(), ElementsAre(1, 0, 0.5, -1));
  EXPECT_THAT(file.nominal.joint_map().offset(), ElementsAre(std::numbers::pi / 2, 0.012));
}

TEST(RobotFileTest, FillsTheJointMap) {
  const RobotFile file =
      Parse(std::string(kTwoJoints) + kChain + "joint_map: {offset_rad: [1, 0]}\n");
  EXPECT_THAT(file.nominal.joint_map().scale(), ElementsAre(1, 0, 0, 1));
  EXPECT_THAT(file.nominal.joint_map().offset(), ElementsAre(1, 0));
}

// Catches: a tool without a rotation that has the zero quaternion, a quaternion of the other sign.
TEST(RobotFileTest, ReadsTools) {
  const RobotFile file = Parse(std::string(kTwoJoints) + kChain +
                               "tools:\n"
                               "  pin: {z_mm: 161}\n"
                               "  hand: {x_m: 1, y_mm: -2, qx: 0, qy: 0, qz: 0.8, qw: -0.6}\n");
  ASSERT_EQ(file.nominal.tools_size(), 2);
  const v1::Tool& pin = file.nominal.tools(0);
  EXPECT_EQ(pin.name(), "pin");
  EXPECT_EQ(pin.pose().z_m(), 0.161);
  EXPECT_EQ(pin.pose().qw(), 1);
  const v1::Pose& hand = file.nominal.tools(1).pose();
  EXPECT_EQ(hand.x_m(), 1);
  EXPECT_EQ(hand.y_m(), -0.002);
  EXPECT_EQ(hand.qz(), -0.8);
  EXPECT_EQ(hand.qw(), 0.6);
}

// Catches: a fault that is found later, by kinematics, and can't name its line any more.
TEST(RobotFileTest, KnowsTheLinesOfTheMessagesFields) {
  const RobotFile file = Parse(std::string(kTwoJoints) +
                               "geometry:\n"
                               "  standard_dh:\n"
                               "    - {theta_deg: 0, d_mm: 0, a_mm: 0, alpha_deg: 90}\n"
                               "    - {theta_deg: 0, d_mm: 0, a_mm: 0, alpha_deg: 90}\n"
                               "  flange:\n"
                               "    - {tz_mm: 1}\n"
                               "joint_map:\n"
                               "  scale: [[1, 0], [0, 1]]\n"
                               "tools:\n"
                               "  pin: {z_mm: 1}\n");
  EXPECT_EQ(file.lines.LineOf("joints[0].lower"), 3);
  EXPECT_EQ(file.lines.LineOf("joints[1]"), 4);
  EXPECT_EQ(file.lines.LineOf("joints[1].upper"), 6);
  EXPECT_EQ(file.lines.LineOf("geometry"), 7);
  EXPECT_EQ(file.lines.LineOf("geometry.standard_dh.rows"), 8);
  EXPECT_EQ(file.lines.LineOf("geometry.standard_dh.rows[1].d_m"), 10);
  EXPECT_EQ(file.lines.LineOf("geometry.flange[0].constant"), 12);
  EXPECT_EQ(file.lines.LineOf("joint_map.scale[3]"), 14);
  EXPECT_EQ(file.lines.LineOf("tools[0].pose"), 16);
  EXPECT_EQ(file.lines.Locate("tools[0].pose"), "r.yaml:16: tools[0].pose");
}

TEST(RobotFileTest, NamesAMissingFile) {
  EXPECT_EQ(ReadRobotFile("no/such.yaml").status().code(), absl::StatusCode::kNotFound);
}

// Catches: masses on the wrong joint (they count from 1 in the file, from 0 in the message), units.
TEST(RobotFileTest, ReadsMasses) {
  const RobotFile file = ValueOf(
      ParseRobotFile("robot: r\njoints: [{name: a, type: revolute}, {name: b, type: prismatic}]\n"
                     "geometry: {chain: [{rz_joint: 1}, {tz_joint: 2}]}\n"
                     "masses:\n  - {joint: b, mass_kg: 5.5, center_mm: [1, 2000, -3]}\n"
                     "  - {joint: 1, mass_kg: 0, center_m: [0, 0, 0.25]}\n",
                     "r.yaml"));
  ASSERT_EQ(file.nominal.masses_size(), 2);
  EXPECT_EQ(file.nominal.masses(0).joint(), 1);
  EXPECT_EQ(file.nominal.masses(0).mass_kg(), 5.5);
  EXPECT_EQ(file.nominal.masses(0).y_m(), 2);
  EXPECT_EQ(file.nominal.masses(0).z_m(), -0.003);
  EXPECT_EQ(file.nominal.masses(1).joint(), 0);
  EXPECT_EQ(file.nominal.masses(1).z_m(), 0.25);
  EXPECT_EQ(file.lines.LineOf("masses[1].mass_kg"), 6);
}

}  // namespace
}  // namespace truepose::formats
