#include "server/store/names.h"

#include <gtest/gtest.h>

#include "tests/store/testing/samples.h"

namespace truepose::store {
namespace {

// Catches a builder and a parser that disagree.
TEST(Names, ComeBackFromTheirParts) {
  EXPECT_EQ(*ParseRobotName(RobotName("ur10-07")), "ur10-07");
  EXPECT_EQ(*ParseSessionName(SessionName(Uuid(5))), Uuid(5));
  EXPECT_EQ(*ParseJobName(JobName(Uuid(6))), Uuid(6));
  EXPECT_EQ(*ParseNominalName(NominalName("ur10", 12)), (NumberedName{"ur10", 12}));
  EXPECT_EQ(*ParseCalibrationName("robots/ur10/calibrations/12"), (NumberedName{"ur10", 12}));
}

// Catches two names of one resource, and names of another collection that are taken.
TEST(Names, OtherFormsAreRefusedWithTheField) {
  for (const char* name :
       {"", "robots", "robots/", "robots/a/b", "robots/A", "robot/a", "/robots/a", "robots/a/"}) {
    EXPECT_FALSE(ParseRobotName(name).ok()) << name;
  }
  for (const char* number : {"0", "-1", "+1", "01", "1x", "", "99999999999999999999"}) {
    EXPECT_FALSE(ParseNominalName(std::string("robots/a/nominals/") + number).ok()) << number;
  }
  EXPECT_FALSE(ParseNominalName("robots/a/calibrations/1").ok());
  EXPECT_FALSE(ParseJobName(SessionName(Uuid(1))).ok());
  EXPECT_EQ(FaultFields(ParseRobotName("x", "parent").status()),
            std::vector<std::string>{"parent"});
}

// Catches an id that can't stand in a name or a URL.
TEST(Names, Ids) {
  EXPECT_TRUE(CheckRobotId("0", "f").ok());
  EXPECT_TRUE(CheckRobotId(std::string(63, 'a'), "f").ok());
  EXPECT_FALSE(CheckRobotId(std::string(64, 'a'), "f").ok());
  EXPECT_FALSE(CheckRobotId("a_b", "f").ok());
  EXPECT_TRUE(CheckUuid("0123abcd-0000-4000-8000-00000000000f", "f").ok());
  EXPECT_FALSE(CheckUuid("0123ABCD-0000-4000-8000-00000000000f", "f").ok()) << "one spelling only";
  EXPECT_FALSE(CheckUuid("0123abcd00004000800000000000000f", "f").ok());
  EXPECT_FALSE(CheckUuid("0123abcd-0000-4000-8000-00000000000g", "f").ok());
}

}  // namespace
}  // namespace truepose::store
