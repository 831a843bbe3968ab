// URDF out, as text; that it moves alike is tested with the exports of convert.
#include "formats/joint_origins.h"
#include "formats/urdf.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

RobotFile TwoJoints() {
  RobotFile file{"arm", RobotOf("RP"), FieldLines()};
  file.nominal.mutable_joints(0)->set_name("a<b&\"c\"");
  file.nominal.mutable_joints(1)->set_name("flange_joint");
  Elements* elements = file.nominal.mutable_geometry()->mutable_chain()->mutable_elements();
  AppendOrigin({0.1, -0.2, 1.0 / 3, 0.3, -0.4, 0.5}, elements);
  AppendJoint(v1::REVOLUTE, 0, elements);
  AppendOrigin({1e-17, 0, 0, 0, 0, 0}, elements);
  AppendJoint(v1::PRISMATIC, 1, elements);
  AppendOrigin({0, 0, 0.107, 0, 0, -0.7}, elements);
  return file;
}

// Catches: digits that are cut, values in the wrong order, names that break the XML, a prismatic
// joint without the limits that URDF demands, two joints of one name.
TEST(UrdfWriterTest, WritesEveryDigitAndName) {
  const std::string text = ValueOf(WriteUrdf(TwoJoints()));
  EXPECT_THAT(text,
              HasSubstr("<origin xyz=\"0.1 -0.2 0.3333333333333333\" rpy=\"0.3 -0.4 0.5\"/>"));
  EXPECT_THAT(text, HasSubstr("name=\"a&lt;b&amp;&quot;c&quot;\" type=\"continuous\""));
  EXPECT_THAT(text, HasSubstr("<limit lower=\"-10000\" upper=\"10000\""));
  EXPECT_THAT(text, HasSubstr("name=\"flange_joint_\" type=\"fixed\""));
  const RobotFile read = ValueOf(ParseUrdf(text, "r.urdf", {}));
  EXPECT_EQ(read.robot_id, "arm");
  ASSERT_EQ(read.nominal.joints_size(), 2);
  EXPECT_EQ(read.nominal.joints(0).name(), "a<b&\"c\"");
  EXPECT_FALSE(read.nominal.joints(1).has_lower());
}

TEST(UrdfWriterTest, RefusesWhatUrdfHasNoPlaceFor) {
  RobotFile mapped = TwoJoints();
  for (const double s : {1, 0, 1, 1}) mapped.nominal.mutable_joint_map()->add_scale(s);
  EXPECT_EQ(Faults(WriteUrdf(mapped)).size(), 1u);
  RobotFile table = TwoJoints();
  table.nominal.mutable_geometry()->mutable_standard_dh();
  EXPECT_EQ(Faults(WriteUrdf(table)).size(), 1u);
  RobotFile turned = TwoJoints();
  turned.nominal.mutable_geometry()->mutable_chain()->mutable_elements(6)->set_axis(v1::X);
  EXPECT_EQ(Faults(WriteUrdf(turned)).size(), 1u);
}

}  // namespace
}  // namespace truepose::formats
