// Whole programs with what becomes of them, looked through by a person once. `golden/NAME` becomes
// `golden/NAME.corrected` and the lists of `golden/NAME.listed`. Catches whatever changes in
// reading or writing, one byte included.
#include <gtest/gtest.h>

#include <numbers>

#include "programs/correct.h"
#include "programs/dialect.h"
#include "tests/programs/samples.h"

namespace truepose::programs {
namespace {

class GoldenTest : public ::testing::TestWithParam<const char*> {};

TEST_P(GoldenTest, BecomesWhatIsWrittenThere) {
  const std::string name = GetParam();
  const auto corrected =
      CorrectProgram(Golden(name), name, *DialectOfFile(name), kSixRevolute, Shifted, {});
  ASSERT_TRUE(corrected.ok()) << corrected.status();
  EXPECT_EQ(corrected->text, Golden(name + ".corrected"));
  std::string listed;
  for (const Remark& remark : corrected->passed_through)
    listed += std::to_string(remark.line) + " " + remark.reason + "\n";
  EXPECT_EQ(listed, Golden(name + ".listed"));
}

INSTANTIATE_TEST_SUITE_P(Dialects, GoldenTest,
                         ::testing::Values("palletize.script", "weld.src", "weld.dat",
                                           "polish.mod"),
                         [](const auto& test) {
                           std::string name = test.param;
                           name[name.find('.')] = '_';
                           return name;
                         });

}  // namespace
}  // namespace truepose::programs
