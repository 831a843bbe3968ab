#include "programs/correct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/fault.h"
#include "tests/programs/samples.h"

namespace truepose::programs {
namespace {

using ::testing::HasSubstr;

constexpr char kTwo[] = "movej([0,0,0,0,0,0.5])\r\n# note\r\nmovej([1,-1,1,-1,1,-1], a=1.4)";

// Has a fault for every target whose first joint is 1.
std::vector<CorrectedJoints> RefusesOne(const std::vector<std::vector<double>>& targets) {
  std::vector<CorrectedJoints> answers = Shifted(targets);
  for (size_t i = 0; i < targets.size(); ++i) {
    if (targets[i][0] == 1.0) answers[i] = {{}, "near a singularity"};
  }
  return answers;
}

absl::StatusOr<CorrectedProgram> Correct(std::string_view text, const Correction& correction,
                                         bool keep = false,
                                         const std::vector<bool>& prismatic = kSixRevolute) {
  return CorrectProgram(text, "p.script", Dialect::kUrScript, prismatic, correction,
                        {.keep_uncorrected = keep});
}

// Would catch bytes lost beside the numbers, CRLF among them, and numbers in another order.
TEST(CorrectTest, ReplacesOnlyTheNumbers) {
  const auto corrected = Correct(kTwo, Shifted);
  ASSERT_TRUE(corrected.ok()) << corrected.status();
  EXPECT_EQ(corrected->text,
            "movej([0.00100000,0.00200000,0.00300000,0.00400000,0.00500000,0.50600000])\r\n"
            "# note\r\nmovej([1.00100000,-0.99800000,1.00300000,-0.99600000,1.00500000,-0.99400000]"
            ", a=1.4)");
  ASSERT_EQ(corrected->changes.size(), 2u);
  EXPECT_EQ(corrected->changes[1].line, 3);
  EXPECT_EQ(corrected->changes[1].before[1], -1.0);
  EXPECT_DOUBLE_EQ(corrected->changes[1].after[1], -0.998);
}

// Would catch degrees taken for rad on the way to the correction or back.
TEST(CorrectTest, UnitsOfEachDialect) {
  std::vector<double> asked;
  const auto remember = [&](const std::vector<std::vector<double>>& targets) {
    asked = targets[0];
    return Unchanged(targets);
  };
  const std::vector<bool> second_slides = {false, true, false, false, false, false};
  const auto krl = CorrectProgram("PTP {A1 180,A2 250,A3 0,A4 0,A5 0,A6 0}", "p", Dialect::kKrl,
                                  second_slides, remember, {});
  ASSERT_TRUE(krl.ok()) << krl.status();
  EXPECT_DOUBLE_EQ(asked[0], std::numbers::pi);
  EXPECT_DOUBLE_EQ(asked[1], 0.25);
  EXPECT_THAT(krl->text, HasSubstr("A1 180.000000,A2 250.000000,"));
  const auto ur = Correct("movej([d2r(180),0.25,3,0,0,0])", remember, false, second_slides);
  ASSERT_TRUE(ur.ok()) << ur.status();
  EXPECT_DOUBLE_EQ(asked[0], std::numbers::pi);
  EXPECT_DOUBLE_EQ(asked[1], 0.25);
  EXPECT_THAT(ur->text, HasSubstr("[d2r(180.000000),0.25000000,3.00000000,"));
}

// Would catch a file with some targets corrected and some not that looks whole, and faults told one
// at a time.
TEST(CorrectTest, OneTargetThatCantBeCorrectedRefusesAll) {
  const std::string text = std::string(kTwo) + "\nmovej([1,2,3])\n";
  const auto corrected = Correct(text, RefusesOne);
  ASSERT_FALSE(corrected.ok());
  EXPECT_EQ(corrected.status().code(), absl::StatusCode::kInvalidArgument);
  const std::vector<Fault> faults = FaultsOf(corrected.status());
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].field, "p.script:3");
  EXPECT_EQ(faults[0].found, "movej: near a singularity");
  EXPECT_EQ(faults[1].field, "p.script:4");
  EXPECT_EQ(faults[1].found, "movej: 3 joint values, but the robot has 6 joints");
}

TEST(CorrectTest, KeptTargetsStayAndAreListed) {
  const auto corrected = Correct(kTwo, RefusesOne, true);
  ASSERT_TRUE(corrected.ok()) << corrected.status();
  EXPECT_THAT(corrected->text, HasSubstr("movej([1,-1,1,-1,1,-1], a=1.4)"));
  EXPECT_THAT(corrected->text, HasSubstr("movej([0.00100000,"));
  EXPECT_EQ(corrected->changes.size(), 1u);
  EXPECT_EQ(corrected->uncorrected, (std::vector<Remark>{{3, "movej: near a singularity"}}));
}

// Would catch lines beyond the faults that are shown being left out of the list.
TEST(CorrectTest, ManyFaultsNameEveryLine) {
  std::string text;
  for (int i = 0; i < 500; ++i) text += "movej([1,0,0,0,0,0])\n";
  const auto corrected = Correct(text, RefusesOne);
  const std::vector<Fault> faults = FaultsOf(corrected.status());
  ASSERT_EQ(faults.size(), 200u);
  EXPECT_EQ(faults[198].field, "p.script:199");
  EXPECT_EQ(faults[199].field, "p.script: lines 200-500");
}

// Would catch half an answer being written.
TEST(CorrectTest, AnswersThatAreNoneAreRefused) {
  const auto few = [](const std::vector<std::vector<double>>&) {
    return std::vector<CorrectedJoints>{};
  };
  EXPECT_EQ(Correct(kTwo, few).status().code(), absl::StatusCode::kInternal);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const auto answer = [&](const std::vector<std::vector<double>>& targets) {
      return std::vector<CorrectedJoints>(targets.size(), {std::vector<double>(6, bad), ""});
    };
    EXPECT_THAT(Correct(kTwo, answer).status().message(), HasSubstr("no valid joints"));
  }
  const auto fails =
      [](const std::vector<std::vector<double>>&) -> absl::StatusOr<std::vector<CorrectedJoints>> {
    return absl::UnavailableError("gone");
  };
  EXPECT_EQ(Correct(kTwo, fails).status(), absl::UnavailableError("gone"));
}

// Would catch a wrist that is turned by tens of degrees for the sake of a millimetre.
TEST(CorrectTest, LargeChangesAreRefused) {
  const auto by = [](double change) {
    return [change](const std::vector<std::vector<double>>& targets) {
      std::vector<CorrectedJoints> answers = Unchanged(targets);
      for (CorrectedJoints& answer : answers) answer.joints[4] += change;
      return answers;
    };
  };
  EXPECT_TRUE(Correct(kTwo, by(0.087)).ok());
  EXPECT_THAT(Correct(kTwo, by(-0.0873)).status().message(),
              HasSubstr("joint 5 would change by 5.002 deg: the target is near a singularity"));
  const std::vector<bool> fifth_slides = {false, false, false, false, true, false};
  EXPECT_TRUE(Correct(kTwo, by(0.0199), false, fifth_slides).ok());
  EXPECT_THAT(Correct(kTwo, by(0.0201), false, fifth_slides).status().message(),
              HasSubstr("joint 5 would change by 20.1 mm"));
}

// A d2r() can't be millimetres.
TEST(CorrectTest, DegreesOfASlideAreAFault) {
  const auto corrected = Correct("movej([d2r(1),0,0,0,0,0])", Unchanged, false,
                                 {true, false, false, false, false, false});
  EXPECT_THAT(corrected.status().message(), HasSubstr("d2r() for joint 1, which slides"));
}

// Would catch a file of two-byte characters read as an empty program.
TEST(CorrectTest, BinaryFilesAreRefused) {
  EXPECT_THAT(Correct(std::string_view("m\0o\0", 4), Unchanged).status().message(),
              HasSubstr("p.script: found a NUL byte"));
}

TEST(CorrectTest, AProgramWithoutTargetsStays) {
  const auto corrected = Correct("def f():\nend\n", Shifted);
  ASSERT_TRUE(corrected.ok());
  EXPECT_EQ(corrected->text, "def f():\nend\n");
  EXPECT_TRUE(corrected->changes.empty());
}

}  // namespace
}  // namespace truepose::programs
