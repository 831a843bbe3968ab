#include "programs/krl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/programs/samples.h"

namespace truepose::programs {
namespace {

using ::testing::HasSubstr;

Program Read(const std::string& text, int joints = 6) { return ReadKrl(text, joints); }

// Would catch axes read in the order of the text, external axes taken for joints, and lower case
// that is not read.
TEST(KrlTest, MotionsWithAxes) {
  const Program program = Read(
      "PTP {A1 0,A2 -90.0,A3 90,A4 0,A5 0,A6 1.5E1}\r\n"
      "  ptp {e6axis: a6 6, a1 - 1,a2 2,a3 3,a4 4,a5 5,E1 7,E2 8.0} C_PTP\r\n"
      "SPTP {A1 1,A2 2,A3 3,A4 4,A5 5,A6 +6} WITH $VEL_AXIS[1]=50\r\n");
  EXPECT_EQ(Targets(program), "1 PTP: 0 -90 90 0 0 15\n2 ptp: -1 2 3 4 5 6\n3 SPTP: 1 2 3 4 5 6\n");
  EXPECT_EQ(Remarks(program), "");
}

// Would catch a .dat file's points that are left because their motions are in the .src file.
TEST(KrlTest, Declarations) {
  const Program program = Read(
      "DEFDAT WELD PUBLIC\nDECL E6AXIS XP1={A1 1,A2 2,A3 3,A4 4,A5 5,A6 6,E1 0.0,E2 0.0}\n"
      "DECL GLOBAL AXIS XP2 = {A1 1,A2 2,A3 3,A4 4,A5 5,A6 7}\nE6AXIS XP[3]\n"
      "XP[2]={A1 1,A2 2,A3 3,A4 4,A5 5,A6 8}\n"
      "DECL FDAT FP1={TOOL_NO 1,BASE_NO 0,IPO_FRAME #BASE,POINT2[] \"A1 0\"}\n"
      "DECL PDAT PPDAT1={VEL 100.000,ACC 100.000,APO_DIST 100.000}\nENDDAT\n");
  EXPECT_EQ(Targets(program), "2 XP1: 1 2 3 4 5 6\n3 XP2: 1 2 3 4 5 7\n5 XP: 1 2 3 4 5 8\n");
  EXPECT_EQ(Remarks(program), "");
}

// Would catch a target in another file that nobody is told of.
TEST(KrlTest, MotionsToVariables) {
  const Program program = Read(
      "E6AXIS XHOME={A1 1,A2 2,A3 3,A4 4,A5 5,A6 6}\nPTP XHOME\nPTP XP2 C_PTP\nPTP P[i]\nLIN "
      "XP3\n");
  EXPECT_EQ(Targets(program), "1 XHOME: 1 2 3 4 5 6\n");
  EXPECT_EQ(Remarks(program),
            "3 moves to 'xp2', which has no plain joint values in this file\n"
            "4 moves to 'p', which has no plain joint values in this file\n"
            "5 moves to 'xp3', which has no plain joint values in this file\n");
}

TEST(KrlTest, VariablesWithOtherUsesStay) {
  for (const char* use : {"XP.A1=XP.A1+10", "XQ=XP", "PTP_REL XP", "FOO(XP)", "IF XP.A1>0 THEN",
                          "PTP XP:XQ", "PTP {A1 XP.A1}"}) {
    const Program program =
        Read(std::string("XP={A1 1,A2 2,A3 3,A4 4,A5 5,A6 6}\nPTP XP\n") + use + "\n");
    EXPECT_EQ(Targets(program), "") << use;
    EXPECT_THAT(Remarks(program), HasSubstr("1 'xp' is used in line 3 other than as")) << use;
  }
}

// Would catch each of these taken for a whole target.
TEST(KrlTest, WhatIsNoTargetIsListed) {
  const std::pair<const char*, const char*> cases[] = {
      {"PTP {A1 10}", "leaves out axes"},
      {"PTP {A2 2,A3 3,A4 4,A5 5,A6 6}", "leaves out axes"},
      {"PTP {A1 x,A2 2,A3 3,A4 4,A5 5,A6 6}", "its axes are no plain numbers"},
      {"PTP {A1 1+1,A2 2,A3 3,A4 4,A5 5,A6 6}", "its axes are no plain numbers"},
      {"PTP {A1 1,A1 1,A2 2,A3 3,A4 4,A5 5,A6 6}", "its axes are no plain numbers"},
      {"PTP {A1 1,A2 2,A3 3,A4 4,A5 5,A6 6", "its axes are no plain numbers"},
      {"PTP {X 1,Y 2,Z 3,A 4,B 5,C 6,S 2,T 35}", "a pose"},
      {"DECL E6POS XP1={X 1,Y 2,Z 3,A 4,B 5,C 6,S 2,T 35,E1 0}", "a pose"},
      {"DECL FRAME F={X 1,Y 2,Z 3}", "a pose"},
      {"PTP_REL {A1 1,A2 2,A3 3,A4 4,A5 5,A6 6}", "a relative motion"},
      {"$H_POS={A1 1,A2 2,A3 3,A4 4,A5 5,A6 6}", "'$h_pos' is a system variable"},
      {"FOO({A1 1,A2 2,A3 3,A4 4,A5 5,A6 6})", "where no target is expected"},
      {"PTP XP1:{X 1}", "its target is calculated"},
      {"MSG(\"abc", "a text without an end"}};
  for (const auto& [line, reason] : cases) {
    const Program program = Read(std::string(line) + "\nPTP {A1 0,A2 0,A3 0,A4 0,A5 0,A6 0}");
    EXPECT_EQ(Targets(program), "2 PTP: 0 0 0 0 0 0\n") << line;
    EXPECT_THAT(Remarks(program), HasSubstr(std::string("1 "))) << line;
    EXPECT_THAT(Remarks(program), HasSubstr(reason)) << line;
  }
}

// Would catch comments, folds and headers that are read.
TEST(KrlTest, CommentsAreNotRead) {
  const Program program = Read(
      "&ACCESS {A1 1}\n;FOLD PTP {A1 1,A2 2,A3 3,A4 4,A5 5,A6 6};%{PE}\nWAIT SEC 0 ;PTP {A1 1}\n");
  EXPECT_EQ(Targets(program) + Remarks(program), "");
}

// Four axes are whole for a robot of four; six of a robot of four are a fault that the caller
// finds.
TEST(KrlTest, AxesThatTheRobotHas) {
  const std::string four = "PTP {A1 1,A2 2,A3 3,A4 4}\n";
  EXPECT_EQ(Targets(Read(four, 4)), "1 PTP: 1 2 3 4\n");
  EXPECT_EQ(Targets(Read(four, 6)), "");
  EXPECT_EQ(Targets(Read("PTP {A1 1,A2 2,A3 3,A4 4,A5 0,A6 0}\n", 4)), "1 PTP: 1 2 3 4 0 0\n");
  EXPECT_EQ(Targets(Read("PTP {A1 1,A2 2,A3 3,A4 4,A5 0,A6 0}\n", 7)), "1 PTP: 1 2 3 4 0 0\n");
}

}  // namespace
}  // namespace truepose::programs
