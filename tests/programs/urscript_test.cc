#include "programs/urscript.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/programs/samples.h"

namespace truepose::programs {
namespace {

using ::testing::HasSubstr;

// Would catch a motion that takes joints and is not read, or a number read in another order.
TEST(UrScriptTest, MotionsWithLists) {
  const Program program = ReadUrScript(
      "movej([0, -1.57, 1.5e0, +3, - 2, .5], a=1.4, v=1.05)\n"
      "movel(pose=[1,2,3,4,5,6],a=1)\n"
      "servoj([1,2,3,4,5,6], 0, 0, 0.008)\n"
      "movec([1,2,3,4,5,6],\n  [6,5,4,3,2,1], r=0.1)\n"
      "movej(\n [d2r(90), -1,\n  0,0,0, d2r( -45.5 )]\n)\n");
  EXPECT_EQ(Targets(program),
            "1 movej: 0 -1.57 1.5 3 -2 0.5\n"
            "2 movel: 1 2 3 4 5 6\n"
            "3 servoj: 1 2 3 4 5 6\n"
            "4 movec: 1 2 3 4 5 6\n"
            "5 movec: 6 5 4 3 2 1\n"
            "7 movej: 90' -1 0 0 0 -45.5'\n");
  EXPECT_EQ(Remarks(program), "");
}

// Would catch velocities, limits or texts taken for joints.
TEST(UrScriptTest, OtherListsAreNoTargets) {
  const Program program = ReadUrScript(
      "speedj([1,2,3,4,5,6], 0.5)\nforce_mode_set_damping(0.1)\nx = [1,2,3,4,5,6]\n"
      "# movej([1,2,3,4,5,6])\ntextmsg(\"movej([1,2,3,4,5,6])\")\nset_tcp(p[0,0,0.1,0,0,0])\n"
      "force_mode(p[0,0,0,0,0,0],[0,0,1,0,0,0],[0,0,9,0,0,0],2,[1,1,1,1,1,1])\n"
      "set_target_payload(1.5, [0,0,0.1], [1,2,3,4,5,6])\nfoo([1,2,3,4,5])\n");
  EXPECT_EQ(Targets(program), "");
  EXPECT_EQ(Remarks(program), "");
}

// Would catch joints that reach the robot uncorrected by a way that nobody is told of.
TEST(UrScriptTest, ListsInOtherCallsAreListed) {
  for (const char* call :
       {"go([0,-1.57,1.57,0,0,0])", "foo(1, [1,2,3,4,5,6], v=2)", "my.movej([1,2,3,4,5,6])",
        "movej_soft([d2r(1),2,3,4,5,6])", "path = [[1,2,3,4,5,6],[6,5,4,3,2,1]]",
        "path = [[1,2,3,4,5,6], q]", "return [1,2,3,4,5,6]", "x = [1,2,3,4,5,6] + d",
        "def f(q=[1,2,3,4,5,6]):", "my.speedj([1,2,3,4,5,6])"}) {
    const Program program = ReadUrScript(std::string(call) + "\n");
    EXPECT_EQ(Targets(program), "") << call;
    EXPECT_EQ(Remarks(program),
              "1 a list of numbers that may be joints, where no known motion has its target\n")
        << call;
  }
}

// Would catch a calculated target that is half replaced, and one that is left without a word.
TEST(UrScriptTest, WhatIsNotPlainIsListed) {
  for (const char* target :
       {"[a,0,0,0,0,0]", "[1,2,3,4,5,6]+d", "[3.14/2,0,0,0,0,0]", "get_inverse_kin(x)", "q[0]",
        "[-d2r(90),0,0,0,0,0]", "[[1,2,3,4,5,6]]", "[1,2,3,4,5,6", "[]", "[0x1,0,0,0,0,0]"}) {
    const Program program = ReadUrScript(std::string("movej(") + target + ", a=1)\n");
    EXPECT_EQ(Targets(program), "") << target;
    EXPECT_EQ(Remarks(program), "1 movej: its target is no plain list of numbers\n") << target;
  }
}

TEST(UrScriptTest, PosesAreListed) {
  const Program program =
      ReadUrScript("movel(p[.1,.2,.3,0,3,0], a=1)\nw=p[1,2,3,4,5,6]\nmovej(w)\n");
  EXPECT_EQ(Targets(program), "");
  EXPECT_THAT(Remarks(program), HasSubstr("1 a pose: the controller finds"));
  EXPECT_THAT(Remarks(program), HasSubstr("2 a pose: the controller finds"));
  EXPECT_THAT(Remarks(program), HasSubstr("3 moves to 'w', which has no plain joint values"));
}

// Would catch lists of variables that are left although each use is a target.
TEST(UrScriptTest, VariablesThatAreOnlyTargets) {
  const Program program = ReadUrScript(
      "def prog():\n  global q1 = [0,0,0,0,0,1] # home\n  movej(q1, a=1)\n  q1=[0,0,0,0,0,2]\n"
      "  movel(q1)\n  local q2=[0,0,0,0,0,3];movej(q=q2)\nend\n");
  EXPECT_EQ(Targets(program), "2 q1: 0 0 0 0 0 1\n4 q1: 0 0 0 0 0 2\n6 q2: 0 0 0 0 0 3\n");
  EXPECT_EQ(Remarks(program), "");
}

// Would catch a value that something else depends on being replaced behind its back.
TEST(UrScriptTest, VariablesWithOtherUsesStay) {
  for (const char* use :
       {"q[0] = 1", "x = q", "foo(q)", "movej(q + d)", "def f(q):", "get_inverse_kin(p1, qnear=q)",
        "set_pos(q)", "movej(f(q), v=1)", "s.q = 1"}) {
    const std::string text = std::string("q = [1,2,3,4,5,6]\nmovej(q)\n") + use + "\n";
    const Program program = ReadUrScript(text);
    EXPECT_EQ(Targets(program), "") << use;
    EXPECT_THAT(Remarks(program), HasSubstr("1 'q' is used in line 3 other than as the target"))
        << use;
    EXPECT_THAT(Remarks(program), HasSubstr("2 moves to 'q', whose joint values are left"));
  }
}

// Would catch a variable that is a list here and a measurement there passing for corrected.
TEST(UrScriptTest, OtherValuesOfAVariableAreListed) {
  const Program program =
      ReadUrScript("q = [1,2,3,4,5,6]\nmovej(q)\nq = get_actual_joint_positions()\nmovej(q)\n");
  EXPECT_EQ(Targets(program), "1 q: 1 2 3 4 5 6\n");
  EXPECT_EQ(Remarks(program), "3 'q' gets a value that is no plain list of numbers\n");
}

TEST(UrScriptTest, ATextWithABackslashIsListed) {
  const Program program = ReadUrScript("textmsg(\"a\\\") movej([1,2,3,4,5,6]) \")\n");
  EXPECT_EQ(Targets(program), "");
  EXPECT_THAT(Remarks(program), HasSubstr("1 a text whose end can't be told"));
}

}  // namespace
}  // namespace truepose::programs
