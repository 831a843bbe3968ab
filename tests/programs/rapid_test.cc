#include "programs/rapid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/programs/samples.h"

namespace truepose::programs {
namespace {

using ::testing::HasSubstr;

constexpr char kNone[] = "[9E9,9E9,9E9,9E9,9E9,9E9]";

std::string Joints(const std::string& last) { return "[[1,2,3,4,5," + last + "]," + kNone + "]"; }

// Would catch external axes taken for joints, and switches taken for the target.
TEST(RapidTest, MotionsWithJoints) {
  const Program program = ReadRapid(
      "MoveAbsJ [[0,-10.5,+3,4,5,1E1],[9E9,9E+09,0,9E9,9E9,9E9]]"
      "\\NoEOffs, v1000, z50, tool0;\n"
      "moveabsj \\Conc, " +
      Joints("7") +
      ",v1000,fine,tool0\\WObj:=w;\n"
      "MoveAbsJ [ [1,2,3,\n  4,5,6], ! rest\n  " +
      kNone + " ], v5, fine, t;\n");
  EXPECT_EQ(Targets(program),
            "1 MoveAbsJ: 0 -10.5 3 4 5 10\n2 moveabsj: 1 2 3 4 5 7\n3 MoveAbsJ: 1 2 3 4 5 6\n");
  EXPECT_EQ(Remarks(program), "");
}

TEST(RapidTest, Declarations) {
  const Program program = ReadRapid(
      "MODULE m\n  CONST jointtarget jHome:=" + Joints("1") + ";\n  LOCAL PERS JointTarget j2 := " +
      Joints("2") + ";\n  VAR jointtarget jp{2}:=[" + Joints("3") + ",\n    " + Joints("4") +
      "];\n  VAR jointtarget j5;\n  PROC main()\n    j5 := " + Joints("5") +
      ";\n    MoveAbsJ jHome,v1000,fine,tool0;\n    MoveAbsJ JP{i}\\NoEOffs,v1000,fine,tool0;\n"
      "    jp{2} := " +
      Joints("6") + ";\n  ENDPROC\nENDMODULE\n");
  EXPECT_EQ(Targets(program),
            "2 jHome: 1 2 3 4 5 1\n3 j2: 1 2 3 4 5 2\n4 jp: 1 2 3 4 5 3\n5 jp: 1 2 3 4 5 4\n"
            "8 j5: 1 2 3 4 5 5\n11 jp: 1 2 3 4 5 6\n");
  EXPECT_EQ(Remarks(program), "");
}

// An axis that the robot doesn't have is no joint.
TEST(RapidTest, AxesOf9E9AreNoJoints) {
  EXPECT_EQ(Targets(ReadRapid("MoveAbsJ [[1,2,3,4,9E9,9E+9]," + std::string(kNone) + "],v,z,t;")),
            "1 MoveAbsJ: 1 2 3 4\n");
}

TEST(RapidTest, VariablesWithOtherUsesStay) {
  for (const char* use : {"j.robax.rax_1:=5;", "k:=j;", "Foo j;", "p:=CalcRobT(j,tool0);",
                          "MoveAbsJ CalcJ(j),v,z,t;", "Foo \\x:=j;"}) {
    const Program program = ReadRapid("CONST jointtarget j:=" + Joints("6") + ";\n" + use + "\n");
    EXPECT_EQ(Targets(program), "") << use;
    EXPECT_THAT(Remarks(program), HasSubstr("1 'j' is used in line 2 other than as")) << use;
  }
}

TEST(RapidTest, WhatIsNoTargetIsListed) {
  const std::pair<std::string, const char*> cases[] = {
      {"MoveL p10,v100,z10,tool0;", "a motion to a robtarget"},
      {"MoveJ Offs(p10,0,0,5),v100,z10,tool0;", "a motion to a robtarget"},
      {"CONST robtarget p:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];",
       "a robtarget"},
      {"MoveAbsJ jOther,v100,z10,tool0;", "moves to 'jother'"},
      {"MoveAbsJ CalcJ(p),v100,z10,tool0;", "its target is no plain jointtarget"},
      {"MoveAbsJ [[a,2,3,4,5,6]," + std::string(kNone) + "],v,z,t;", "its target is no plain"},
      {"MoveAbsJ [[1,2,3,4,5,6],[9E9]],v,z,t;", "its target is no plain jointtarget"},
      {"MoveAbsJ [[1,2,3,4,5,6]," + std::string(kNone) + "]+d,v,z,t;", "its target is no plain"},
      {"VAR jointtarget k:=CalcJ(p);", "'k' gets a value that is no plain jointtarget"},
      {"other:=" + Joints("6") + ";", "does not declare as jointtarget"},
      {"p:=CalcRobT(" + Joints("6") + ",tool0);", "joint values that are neither"},
      {"MoveExtJ " + Joints("6") + ",vrot10,fine;", "joint values that are neither"},
      {"Go [" + Joints("6") + "," + Joints("7") + "];", "joint values that are neither"},
      {"j.robax:=[1,2,3,4,5,6];", "joint values that are neither"},
      {"VAR robjoint r:=[1,2,3,4,5,6];", "does not declare as jointtarget"},
      {"TPWrite \"abc", "a text without an end"}};
  for (const auto& [line, reason] : cases) {
    const Program program = ReadRapid(line + "\nMoveAbsJ " + Joints("0") + ",v,z,t;");
    EXPECT_EQ(Targets(program), "2 MoveAbsJ: 1 2 3 4 5 0\n") << line;
    EXPECT_THAT(Remarks(program), HasSubstr(std::string("1 "))) << line;
    EXPECT_THAT(Remarks(program), HasSubstr(reason)) << line;
  }
}

TEST(RapidTest, CommentsAndTextsAreNotRead) {
  const Program program =
      ReadRapid("! MoveAbsJ " + Joints("6") + ",v,z,t;\nTPWrite \"MoveL \"\"p\"\",\";\n");
  EXPECT_EQ(Targets(program) + Remarks(program), "");
}

}  // namespace
}  // namespace truepose::programs
