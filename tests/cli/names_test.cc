#include "client/cli/names.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "core/base/fault.h"

namespace truepose::cli {
namespace {

// Would catch a prefix that is doubled or missing.
TEST(Names, TakeShortAndFullForms) {
  EXPECT_EQ(RobotName("ur10"), "robots/ur10");
  EXPECT_EQ(RobotName("robots/ur10"), "robots/ur10");
  EXPECT_EQ(RobotName(""), "");
  EXPECT_EQ(SessionName("1-2"), "sessions/1-2");
  EXPECT_EQ(JobName("jobs/1-2"), "jobs/1-2");
  EXPECT_EQ(CalibrationName("ur10#12").value(), "robots/ur10/calibrations/12");
  EXPECT_EQ(CalibrationName("robots/ur10#12").value(), "robots/ur10/calibrations/12");
  EXPECT_EQ(CalibrationName("robots/ur10/calibrations/12").value(), "robots/ur10/calibrations/12");
}

// Would catch a wrong name that reaches the server as something else.
TEST(CalibrationName, RefusesOtherForms) {
  for (const char* typed : {"", "ur10", "ur10#", "#1", "ur10#x", "ur10#1#2", "robots/ur10",
                            "a/b/calibrations/1", "robots/ur10/nominals/1", "ur10#-1"}) {
    const auto name = CalibrationName(typed);
    ASSERT_FALSE(name.ok()) << typed;
    ASSERT_EQ(FaultsOf(name.status()).size(), 1u) << typed;
    EXPECT_EQ(FaultsOf(name.status())[0].field, "--calibration");
  }
}

TEST(ShortName, UndoesEachForm) {
  EXPECT_EQ(ShortName("robots/ur10"), "ur10");
  EXPECT_EQ(ShortName("sessions/1-2"), "1-2");
  EXPECT_EQ(ShortName("robots/ur10/calibrations/12"), "ur10#12");
  EXPECT_EQ(ShortName("robots/ur10/nominals/1"), "robots/ur10/nominals/1");
  EXPECT_EQ(ShortName("ur10"), "ur10");
}

// Would catch wrong version or variant bits, which the server refuses, and repeats.
TEST(RandomUuid, IsOfVersionFourAndNew) {
  const std::regex form("[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}");
  std::set<std::string> seen;
  for (int i = 0; i < 200; ++i) {
    const std::string uuid = RandomUuid();
    EXPECT_TRUE(std::regex_match(uuid, form)) << uuid;
    EXPECT_TRUE(seen.insert(uuid).second) << uuid;
  }
}

}  // namespace
}  // namespace truepose::cli
