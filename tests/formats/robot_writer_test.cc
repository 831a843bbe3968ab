// What is written reads back equal, to the bit.
#include <cmath>
#include <random>

#include "formats/robot_file.h"
#include "gmock/gmock.h"
#include "google/protobuf/util/message_differencer.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::google::protobuf::util::MessageDifferencer;
using Element = v1::ElementaryTransform;

void ExpectRoundTrip(const RobotFile& file) {
  const std::string text = WriteRobotFile(file);
  const RobotFile again = ValueOf(ParseRobotFile(text, "r.yaml"));
  EXPECT_EQ(again.robot_id, file.robot_id);
  EXPECT_TRUE(MessageDifferencer::Equals(again.nominal, file.nominal)) << text;
}

class RandomRobot {
 public:
  explicit RandomRobot(uint64_t seed) : random_(seed) {}

  RobotFile Make() {
    RobotFile file{"r", {}, FieldLines()};
    v1::Nominal& nominal = file.nominal;
    nominal.set_kind(Coin() ? v1::MEASURING : v1::INDUSTRIAL);
    if (Coin()) nominal.set_serial("0" + std::to_string(random_()) + " \"x\" \xC3\xBC");
    const int n = 1 + random_() % 6;
    for (int i = 0; i < n; ++i) AddJoint(nominal, i);
    SetGeometry(nominal, n);
    if (Coin()) SetJointMap(nominal, n);
    if (Coin()) AddTool(nominal);
    while (Coin()) AddMass(nominal, n);
    return file;
  }

 private:
  bool Coin() { return random_() % 2 == 0; }
  // Round in mm and deg, or any bits at all.
  double Value() {
    if (Coin()) return (static_cast<int>(random_() % 2001) - 1000) / 1000.0;
    return std::uniform_real_distribution<double>(-4, 4)(random_);
  }

  void AddMass(v1::Nominal& nominal, int n) {
    v1::LinkMass* mass = nominal.add_masses();
    mass->set_joint(random_() % n);
    mass->set_mass_kg(std::abs(Value()));
    mass->set_x_m(Value());
    mass->set_y_m(Value());
    mass->set_z_m(Value());
  }

  void AddJoint(v1::Nominal& nominal, int i) {
    v1::Joint* joint = nominal.add_joints();
    joint->set_name("joint " + std::to_string(i));
    joint->set_type(Coin() ? v1::PRISMATIC : v1::REVOLUTE);
    if (Coin()) joint->set_lower(Value() - 8);
    if (Coin()) joint->set_upper(Value() + 8);
  }

  void SetGeometry(v1::Nominal& nominal, int n) {
    v1::Geometry* geometry = nominal.mutable_geometry();
    const int form = random_() % 3;
    if (form == 0) AddRows(geometry->mutable_standard_dh(), n);
    if (form == 1) AddRows(geometry->mutable_craig_dh(), n);
    for (int i = 0; form == 2 && i < n; ++i) {
      *geometry->mutable_chain()->add_elements() = Constant();
      Element* moved = geometry->mutable_chain()->add_elements();
      *moved = Constant();
      moved->set_motion(nominal.joints(i).type() == v1::PRISMATIC ? Element::TRANSLATION
                                                                  : Element::ROTATION);
      moved->set_joint(i);
      if (Coin()) moved->set_constant(0);
    }
    if (Coin()) *geometry->add_flange() = Constant();
  }

  void AddRows(v1::DhTable* table, int n) {
    for (int i = 0; i < n; ++i) {
      v1::DhRow* row = table->add_rows();
      row->set_theta_rad(Value());
      row->set_d_m(Value());
      row->set_a_m(Value());
      row->set_alpha_rad(Value());
    }
  }

  Element Constant() {
    Element element;
    element.set_motion(Coin() ? Element::ROTATION : Element::TRANSLATION);
    element.set_axis(static_cast<v1::Axis>(1 + random_() % 3));
    element.set_constant(Value());
    return element;
  }

  void SetJointMap(v1::Nominal& nominal, int n) {
    for (int i = 0; i < n * n; ++i) nominal.mutable_joint_map()->add_scale(Value());
    for (int i = 0; i < n; ++i) nominal.mutable_joint_map()->add_offset(Value());
  }

  void AddTool(v1::Nominal& nominal) {
    v1::Tool* tool = nominal.add_tools();
    tool->set_name("null");
    const double half = std::abs(Value()) / 3;
    tool->mutable_pose()->set_x_m(Value());
    tool->mutable_pose()->set_qy(std::sin(half));
    tool->mutable_pose()->set_qw(std::cos(half));
  }

  std::mt19937_64 random_;
};

// Catches: a field that the writer forgets or rounds, for every form of geometry.
TEST(RobotWriterTest, RandomRobotsReadBackToTheBit) {
  RandomRobot robots(42);
  for (int i = 0; i < 500 && !testing::Test::HasFailure(); ++i) ExpectRoundTrip(robots.Make());
}

// Catches: a file that only a machine wants to read: data sheet values have to look like the data
// sheet's.
TEST(RobotWriterTest, WritesRoundValuesInPeoplesUnits) {
  const std::string text =
      "robot: r\n"
      "serial: \"42\"\n"
      "kind: industrial\n"
      "joints:\n"
      "  - {name: a, type: revolute, lower_deg: -360, upper_deg: 360}\n"
      "geometry:\n"
      "  standard_dh:\n"
      "    - {theta_deg: 0, d_mm: 127.3, a_mm: -612, alpha_deg: 90}\n"
      "  flange:\n"
      "    - {tz_mm: 107}\n"
      "tools:\n"
      "  pin: {x_mm: 0, y_mm: 0, z_mm: 161, qx: 0, qy: 0, qz: 0, qw: 1}\n";
  EXPECT_EQ(WriteRobotFile(ValueOf(ParseRobotFile(text, "r.yaml"))), text);
}

}  // namespace
}  // namespace truepose::formats
