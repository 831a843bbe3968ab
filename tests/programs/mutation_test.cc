// Thousands of damaged programs. Whatever is left of them, reading ends, and a correction changes
// nothing beside the numbers that it replaces. Catches: a crash, an endless loop, a proof that
// fails on our own writing, bytes lost; under sanitizers every bad access.
#include <gtest/gtest.h>

#include <algorithm>

#include "programs/correct.h"
#include "programs/dialect.h"
#include "programs/mark.h"
#include "tests/formats/damage.h"
#include "tests/programs/samples.h"

namespace truepose::programs {
namespace {

constexpr int kCases = 4000;

constexpr testing::DamageManner kManner{
    .likely = "\"'[](){}:=,;.!#&\\\n\r\t -+0123456789eEaApP$_\xFC",
    .most_places = 6,
    .longest = 60};

// Without a NUL, for which a program is refused whole.
std::string Damaged(const std::string& whole, testing::Mutator* mutator) {
  std::string text = mutator->Damage(whole);
  std::replace(text.begin(), text.end(), '\0', ' ');
  return text;
}

// The text with every joint number that was replaced taken out.
std::string Rest(const std::string& text, const Program& program,
                 const std::vector<Change>& changes) {
  std::vector<JointNumber> numbers;
  for (const JointTarget& target : program.targets) {
    const bool changed = std::any_of(changes.begin(), changes.end(),
                                     [&](const Change& c) { return c.line == target.line; });
    if (changed) numbers.insert(numbers.end(), target.joints.begin(), target.joints.end());
  }
  std::sort(numbers.begin(), numbers.end(),
            [](const JointNumber& a, const JointNumber& b) { return a.begin > b.begin; });
  std::string rest = text;
  for (const JointNumber& n : numbers) rest.erase(n.begin, n.end - n.begin);
  return rest;
}

class MutationTest : public ::testing::TestWithParam<const char*> {};

TEST_P(MutationTest, DamagedProgramsKeepTheirBytes) {
  const std::string name = GetParam(), whole = Golden(name);
  const Dialect dialect = *DialectOfFile(name);
  testing::Mutator mutator(7, kManner);
  int corrected_programs = 0;
  for (int i = 0; i < kCases && !HasFailure(); ++i) {
    const std::string text = Damaged(whole, &mutator);
    const auto corrected =
        CorrectProgram(text, name, dialect, kSixRevolute, Shifted, {.keep_uncorrected = true});
    ASSERT_TRUE(corrected.ok()) << corrected.status() << "\n" << text;
    corrected_programs += !corrected->changes.empty();
    const Program before = ReadProgram(text, dialect, 6);
    const Program after = ReadProgram(corrected->text, dialect, 6);
    EXPECT_EQ(Rest(text, before, corrected->changes),
              Rest(corrected->text, after, corrected->changes));
  }
  // A mutator that leaves nothing to correct would test nothing.
  EXPECT_GT(corrected_programs, kCases / 2);
}

// Would catch a mark that is understood as a part of what stands around it, or is not seen again.
TEST_P(MutationTest, DamagedProgramsTakeAMark) {
  const std::string name = GetParam(), whole = Golden(name);
  const Dialect dialect = *DialectOfFile(name);
  testing::Mutator mutator(11, kManner);
  for (int i = 0; i < kCases && !HasFailure(); ++i) {
    const std::string text = Damaged(whole, &mutator);
    const auto marked = AddMark(text, dialect, 6, "ab12");
    ASSERT_TRUE(marked.ok()) << marked.status() << "\n" << text;
    const auto found = FindMark(marked->text, dialect);
    ASSERT_TRUE(found.has_value()) << marked->text;
    EXPECT_EQ(found->line, marked->line);
    EXPECT_FALSE(FindMark(text, dialect).has_value());
  }
}

INSTANTIATE_TEST_SUITE_P(Dialects, MutationTest,
                         ::testing::Values("palletize.script", "weld.src", "weld.dat",
                                           "polish.mod"),
                         [](const auto& test) {
                           std::string name = test.param;
                           name[name.find('.')] = '_';
                           return name;
                         });

// Would catch a reader that looks ahead without bound: each of these takes minutes then, and
// milliseconds in proportion to the text.
TEST(MutationTest, LongNonsenseIsReadInOneGo) {
  for (const Dialect dialect : {Dialect::kUrScript, Dialect::kKrl, Dialect::kRapid}) {
    for (const char* piece : {"movej(", "movec(", "[", "{A1 ", "PTP {", "MoveAbsJ ", "a{", "set_x(",
                              "a=[", "\"", "\n\n", "movec([1,", "A1 1,", "MoveAbsJ \\",
                              "jointtarget ", "d2r(", "p[", "x:=[[", "PTP a["}) {
      std::string text;
      while (text.size() < 400'000) text += piece;
      const Program program = ReadProgram(text, dialect, 6);
      EXPECT_TRUE(program.targets.empty()) << piece;
    }
  }
}

}  // namespace
}  // namespace truepose::programs
