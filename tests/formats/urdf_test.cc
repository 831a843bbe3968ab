// URDF in: the chain is the tree's own kinematics, and what it can't be is a clear fault.
#include "formats/urdf.h"

#include <urdf_parser/urdf_parser.h>

#include <cmath>
#include <map>

#include "core/base/random.h"
#include "core/chain/chain.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string Link(const std::string& name) { return "<link name=\"" + name + "\"/>\n"; }

std::string Joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& more = "") {
  const bool limited = type == "revolute" || type == "prismatic";
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" +
         (limited ? "<limit lower=\"-2\" upper=\"2.5\" effort=\"1\" velocity=\"1\"/>" : "") + more +
         "</joint>\n";
}

std::string RobotText(const std::string& content) {
  return "<?xml version=\"1.0\"?>\n<robot name=\"Test Arm\">\n" + content + "</robot>\n";
}

RobotFile Parsed(const std::string& text, const UrdfEnds& ends = {}) {
  return ValueOf(ParseUrdf(text, "r.urdf", ends));
}

// The message as a chain of core, without convert.
Chain ChainOf(const v1::Nominal& nominal) {
  Chain chain;
  for (const v1::ElementaryTransform& e : nominal.geometry().chain().elements()) {
    chain.push_back(
        {e.motion() == v1::ElementaryTransform::ROTATION ? Motion::kRotation : Motion::kTranslation,
         static_cast<Axis>(e.axis() - 1), e.constant(), e.has_joint() ? e.joint() : -1, -1});
  }
  return chain;
}

Pose PoseOf(const urdf::Pose& pose) {
  double x, y, z, w;
  pose.rotation.getQuaternion(x, y, z, w);
  return {Eigen::Quaterniond(w, x, y, z).toRotationMatrix(),
          {pose.position.x, pose.position.y, pose.position.z}};
}

Pose MotionOf(const urdf::Joint& joint, double q) {
  const Eigen::Vector3d u = Eigen::Vector3d(joint.axis.x, joint.axis.y, joint.axis.z).normalized();
  Pose X;
  if (joint.type == urdf::Joint::PRISMATIC) X.p = q * u;
  if (joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS)
    X.R = Eigen::AngleAxisd(q, u).toRotationMatrix();
  return X;
}

// Forward kinematics of urdfdom's tree, from its own poses and axes.
Pose TreeForward(const urdf::ModelInterface& model, const std::string& tip,
                 const std::map<std::string, double>& q) {
  Pose X;
  for (auto link = model.getLink(tip); link->parent_joint; link = link->getParent()) {
    const urdf::Joint& joint = *link->parent_joint;
    const auto value = q.find(joint.name);
    X = PoseOf(joint.parent_to_joint_origin_transform) *
        MotionOf(joint, value == q.end() ? 0 : value->second) * X;
  }
  return X;
}

// An arm with every kind of joint, skew axes of any length, pitches of a quarter turn, fixed joints
// before, between and behind, and a branch beside it.
std::string RandomArm(Random* random) {
  const auto number = [&](double range) { return std::to_string(random->Uniform(-range, range)); };
  std::string text = Link("l0");
  for (int i = 0; i < 9; ++i) {
    const std::vector<std::string> types = {"fixed", "revolute", "continuous", "prismatic"};
    const std::vector<std::string> axes = {"1 0 0",
                                           "0 1 0",
                                           "0 0 1",
                                           "0 0 -1",
                                           "-1 0 0",
                                           "0.6 0 0.8",
                                           number(3) + " " + number(3) + " " + number(3)};
    const std::string pitch = i % 3 == 0 ? "1.5707963267948966" : number(3);
    const std::string type = i % 4 == 0 ? "fixed" : types[random->Below(4)];
    const std::string next = "l" + std::to_string(i + 1);
    text += Link(next) + Joint("j" + std::to_string(i), type, "l" + std::to_string(i), next,
                               "<origin xyz=\"" + number(1) + " " + number(1) + " " + number(1) +
                                   "\" rpy=\"" + number(3) + " " + pitch + " " + number(3) +
                                   "\"/><axis xyz=\"" + axes[random->Below(axes.size())] + "\"/>");
  }
  return RobotText(text + Link("side") + Joint("s", "continuous", "l3", "side"));
}

// Catches: a wrong order of rpy, an axis turned the wrong way, a fixed joint that is lost,
// urdfdom's rounding of pitch near a quarter turn.
TEST(UrdfTest, ChainIsTheTreesForwardKinematics) {
  Random random(1);
  for (int robot = 0; robot < 200; ++robot) {
    const std::string text = RandomArm(&random);
    const auto model = urdf::parseURDF(text);
    ASSERT_TRUE(model != nullptr);
    const auto file = ParseUrdf(text, "r.urdf", {"", "l9"});
    if (!file.ok()) {
      // A draw without a movable joint.
      EXPECT_THAT(Faults(file)[0], HasSubstr("found 0 movable joints"));
      continue;
    }
    std::map<std::string, double> values;
    Eigen::VectorXd q(file->nominal.joints_size());
    for (int i = 0; i < q.size(); ++i) {
      q(i) = random.Uniform(-3, 3);
      values[file->nominal.joints(i).name()] = q(i);
    }
    const Pose a = Forward<double>(ChainOf(file->nominal), q.data(), nullptr),
               b = TreeForward(*model, "l9", values);
    // Rounding of 40 elements over some 20 m.
    EXPECT_LT((a.p - b.p).norm(), 1e-12);
    EXPECT_LT((a.R - b.R).norm(), 1e-12);
  }
}

const std::string kArm =  // NOLINT: a text of this test
    Link("base") + Link("a") + Link("b") + Link("tool") +
    Joint("turn", "continuous", "base", "a", "<axis xyz=\"0 0 1\"/>") +
    Joint("slide", "prismatic", "a", "b", "<axis xyz=\"1 0 0\"/>") +
    Joint("mount", "fixed", "b", "tool");

// Catches: names, types or limits that are lost; a limit of a continuous joint.
TEST(UrdfTest, ReadsJoints) {
  const RobotFile file = Parsed(RobotText(kArm));
  EXPECT_EQ(file.robot_id, "test-arm");
  EXPECT_EQ(file.nominal.model(), "Test Arm");
  EXPECT_EQ(file.nominal.kind(), v1::INDUSTRIAL);
  ASSERT_EQ(file.nominal.joints_size(), 2);
  EXPECT_EQ(file.nominal.joints(0).name(), "turn");
  EXPECT_EQ(file.nominal.joints(0).type(), v1::REVOLUTE);
  EXPECT_FALSE(file.nominal.joints(0).has_lower());
  EXPECT_EQ(file.nominal.joints(1).type(), v1::PRISMATIC);
  EXPECT_EQ(file.nominal.joints(1).lower(), -2);
  EXPECT_EQ(file.nominal.joints(1).upper(), 2.5);
}

// Catches: limits that mean none read as a joint that can't move.
TEST(UrdfTest, LimitsThatMeanNoneAreNone) {
  std::string text = RobotText(kArm);
  const std::string given = "lower=\"-2\" upper=\"2.5\"";
  text.replace(text.find(given), given.size(), "lower=\"0\" upper=\"0\"");
  EXPECT_FALSE(Parsed(text).nominal.joints(1).has_upper());
  text = RobotText(kArm);
  text.replace(text.find(given), given.size(), "lower=\"0\" upper=\"10000\"");
  EXPECT_TRUE(Parsed(text).nominal.joints(1).has_lower());
  EXPECT_FALSE(Parsed(text).nominal.joints(1).has_upper());
}

// Catches: ends that are ignored; joints beside the chain that are read or refused.
TEST(UrdfTest, BaseAndTipChooseTheChain) {
  const std::string text =
      RobotText(kArm + Link("finger") + Link("wheel") +
                Joint("grip", "prismatic", "tool", "finger", "<mimic joint=\"slide\"/>") +
                Joint("roll", "floating", "base", "wheel"));
  EXPECT_THAT(Faults(ParseUrdf(text, "r.urdf", {})),
              ElementsAre("r.urdf: found 2 links without a joint below them, expected the link of "
                          "the flange, named with --urdf-tip LINK, such as finger or wheel"));
  EXPECT_EQ(Parsed(text, {"", "tool"}).nominal.joints_size(), 2);
  EXPECT_EQ(Parsed(text, {"a", "tool"}).nominal.joints(0).name(), "slide");
  EXPECT_THAT(Faults(ParseUrdf(text, "r.urdf", {"", "finger"})),
              ElementsAre("r.urdf: joint 'grip': found a joint that mimics another, expected "
                          "revolute, continuous, prismatic or fixed joints on the chain"));
  EXPECT_THAT(Faults(ParseUrdf(text, "r.urdf", {"tool", "a"})),
              ElementsAre("r.urdf: link 'a': found not below 'tool', expected a tip below the "
                          "base"));
  EXPECT_THAT(Faults(ParseUrdf(text, "r.urdf", {"", "tol"})),
              ElementsAre("r.urdf: link 'tol': found no such link, expected tool"));
}

TEST(UrdfTest, NamesEveryJointThatCantBe) {
  const std::string text =
      RobotText(Link("l0") + Link("l1") + Link("l2") + Link("l3") +
                Joint("a", "floating", "l0", "l1") + Joint("b", "planar", "l1", "l2") +
                Joint("c", "continuous", "l2", "l3", "<axis xyz=\"0 0 0\"/>"));
  const std::string types = "expected revolute, continuous, prismatic or fixed joints on the chain";
  EXPECT_THAT(Faults(ParseUrdf(text, "r.urdf", {})),
              ElementsAre("r.urdf: joint 'a': found a floating joint, " + types,
                          "r.urdf: joint 'b': found a planar joint, " + types,
                          "r.urdf: joint 'c': found an axis of length 0, expected a direction"));
}

TEST(UrdfTest, NamesWhatIsNoRobot) {
  EXPECT_THAT(Faults(ParseUrdf("<robot name=\"r\"><link", "r.urdf", {})).at(0),
              HasSubstr("r.urdf: found "));
  EXPECT_FALSE(ParseUrdf("", "r.urdf", {}).ok());
  EXPECT_FALSE(ParseUrdf("<html/>", "r.urdf", {}).ok());
  EXPECT_FALSE(ParseUrdf(RobotText(Link("a") + Joint("j", "fixed", "a", "b")), "r.urdf", {}).ok());
  EXPECT_FALSE(ParseUrdf("<robot name=\"\xff\"/>", "r.urdf", {}).ok());
  EXPECT_THAT(Faults(ParseUrdf(RobotText(Link("a") + Link("b") + Joint("j", "fixed", "a", "b")),
                               "r.urdf", {})),
              ElementsAre("r.urdf: found 0 movable joints from base to tip, expected 1 to 64"));
  EXPECT_THAT(
      Faults(ParseUrdf(
          RobotText(Link("a") + Link("b") + Link("c") + Joint("i", "continuous", "a", "b") +
                    Joint("j", "continuous", "a", "c") + Joint("k", "continuous", "b", "c")),
          "r.urdf", {})),
      ElementsAre("r.urdf: link 'c': found the child of joints 'j' and 'k', expected one joint "
                  "above each link"));
}

// Catches: a hostile file that ends the process by recursion.
TEST(UrdfTest, DeepAndWideFilesAreRefused) {
  std::string deep, wide;
  for (int i = 0; i < 200000; ++i) deep += "<a b='/>'>";
  EXPECT_THAT(Faults(ParseUrdf(deep, "r.urdf", {})).at(0), HasSubstr("nested too deeply"));
  for (int i = 0; i < 3000; ++i) wide += Link("l" + std::to_string(i));
  EXPECT_THAT(Faults(ParseUrdf(RobotText(wide), "r.urdf", {})).at(0), HasSubstr("3000 links"));
}

// Catches: comments or text that count as nesting.
TEST(UrdfTest, CommentsDoNotCount) {
  std::string comments;
  for (int i = 0; i < 300; ++i) comments += "<!-- <a> <b> -->\n";
  EXPECT_EQ(Parsed(RobotText(comments + kArm)).nominal.joints_size(), 2);
}

// A link of 3 kg that the slide carries, 0.5 kg on a finger beside the chain, and a base that
// nothing carries: would catch masses of the wrong joint, or centres in the link's frame.
TEST(UrdfTest, ReadsMasses) {
  const auto inertial = [](double mass) {
    return "<inertial><origin xyz=\"0 0 0.1\" rpy=\"1 0 0\"/><mass value=\"" +
           std::to_string(mass) +
           "\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial>";
  };
  const std::string text =
      RobotText("<link name=\"base\">" + inertial(9) + "</link>" + Link("a") + "<link name=\"b\">" +
                inertial(3) + "</link>" + Link("tool") + "<link name=\"finger\">" + inertial(0.5) +
                "</link>" + Joint("turn", "continuous", "base", "a", "<origin xyz=\"0 0 1\"/>") +
                Joint("slide", "prismatic", "a", "b",
                      "<origin xyz=\"1 0 0\" rpy=\"0 1.5707963267948966 0\"/>") +
                Joint("mount", "fixed", "b", "tool") +
                Joint("grip", "continuous", "b", "finger", "<origin xyz=\"0 2 0\"/>"));
  const v1::Nominal nominal = Parsed(text, {"", "tool"}).nominal;
  ASSERT_EQ(nominal.masses_size(), 2);
  double total = 0;
  for (const v1::LinkMass& mass : nominal.masses()) {
    total += mass.mass_kg();
    EXPECT_EQ(mass.joint(), 1);
    // Rounding of a quarter turn.
    EXPECT_NEAR(mass.x_m(), 1.1, 1e-12);
    EXPECT_NEAR(mass.y_m(), mass.mass_kg() == 3 ? 0 : 2, 1e-12);
    EXPECT_NEAR(mass.z_m(), 1, 1e-12);
  }
  EXPECT_EQ(total, 3.5);
}

// Catches: an example of the page that a reader copies and that is refused.
TEST(UrdfTest, ExampleOfThePageIsRead) {
  const std::string page = TextOf(TRUEPOSE_SOURCE_DIR "/docs/formats.md");
  const size_t begin = page.find("```xml\n") + 7;
  const std::string example = page.substr(begin, page.find("```", begin) - begin);
  const RobotFile file = Parsed(example);
  EXPECT_EQ(file.robot_id, "two-axes");
  ASSERT_EQ(file.nominal.joints_size(), 2);
  EXPECT_EQ(file.nominal.joints(1).upper(), 0.5);
}

TEST(UrdfTest, TellsXmlFromYaml) {
  EXPECT_TRUE(LooksLikeXml("\xEF\xBB\xBF \n<?xml version=\"1.0\"?>"));
  EXPECT_TRUE(LooksLikeXml("<robot/>"));
  EXPECT_FALSE(LooksLikeXml("robot: r\n"));
  EXPECT_FALSE(LooksLikeXml(""));
}

}  // namespace
}  // namespace truepose::formats
