// Programs made of random targets between random lines. Whatever joints a correction gives, they
// are what the new program says, and everything else is as it was. Catches a form that is written
// but not read, digits lost in printing, spans that are off by one.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "formats/number.h"
#include "programs/correct.h"
#include "programs/written_number.h"
#include "tests/programs/samples.h"

namespace truepose::programs {
namespace {

using Joints = std::vector<double>;

// One seed for all runs.
class RoundTripTest : public ::testing::TestWithParam<Dialect> {
 protected:
  static void SetUpTestSuite() { setenv("RC_PARAMS", "seed=20261123 max_success=400", 1); }
};

rc::Gen<double> AnyNumber() {
  return rc::gen::map(rc::gen::inRange<int64_t>(-360'000'000, 360'000'000), [](int64_t micro) {
    return static_cast<double>(micro) * (micro % 3 == 0 ? 1e-6 : 1e-4);
  });
}

rc::Gen<Joints> AnyJoints() { return rc::gen::container<Joints>(6, AnyNumber()); }

std::string List(const Joints& joints, const char* between) {
  std::string text;
  for (size_t j = 0; j < joints.size(); ++j)
    text += (j > 0 ? between : "") + formats::FormatNumber(joints[j]);
  return text;
}

std::string Axes(const Joints& joints, int order) {
  std::string text;
  for (int k = 0; k < 6; ++k) {
    const int j = (order * k + order) % 6;  // order 1 and 5 are permutations
    text += (k > 0 ? "," : "") + std::string("A") + std::to_string(j + 1) + " " +
            formats::FormatNumber(joints[static_cast<size_t>(j)]);
  }
  return text;
}

constexpr char kExternal[] = ",[9E9,9E+09,0,9E9,9E9,9E9]]";

std::string TargetText(Dialect dialect, const Joints& joints, int form, size_t index) {
  const std::string name = "x" + std::to_string(index);
  switch (dialect) {
    case Dialect::kUrScript:
      if (form == 0) return "movej([" + List(joints, ",") + "], a=1.2)\n";
      if (form == 1) return "movel([ " + List(joints, " ,\n  ") + "])\r\n";
      return name + " = [" + List(joints, ", ") + "]\nmovej(" + name + ")\n";
    case Dialect::kKrl:
      if (form == 0) return "PTP {" + Axes(joints, 1) + "} C_PTP\r\n";
      if (form == 1) return "SPTP {E6AXIS: " + Axes(joints, 5) + ",E1 100}\n";
      return "DECL E6AXIS " + name + "={" + Axes(joints, 1) + ",E1 0.0,E2 0}\n";
    case Dialect::kRapid:
      if (form == 0) return "MoveAbsJ [[" + List(joints, ",") + "]" + kExternal + ",v10,fine,t;\n";
      if (form == 1)
        return "moveabsj \\Conc,[ [" + List(joints, "\n,") + "]" + kExternal + "\\NoEOffs,v,z,t;\n";
      return "PERS jointtarget " + name + ":=[[" + List(joints, ", ") + "]" + kExternal + ";\n";
  }
  return "";
}

// Lines of no target, in the mind of no dialect.
const std::vector<std::string> kOther = {"",
                                         "\r\n",
                                         "  \t\n",
                                         "; c\n",
                                         "# movej([1,2,3,4,5,6])\n",
                                         "! PTP {A1 1}\n",
                                         "\xFC\xE4 = 3;\n",
                                         "x := foo(3, [1,2]);\n"};

double NumberIn(std::string_view text, const JointNumber& n) {
  std::string digits(text.substr(n.begin, n.end - n.begin));
  std::erase(digits, ' ');
  return std::strtod(digits.c_str(), nullptr);
}

TEST_P(RoundTripTest, TheNewProgramSaysTheCorrectedJoints) {
  const Dialect dialect = GetParam();
  EXPECT_TRUE(rc::check([&] {
    const auto targets = *rc::gen::container<std::vector<Joints>>(AnyJoints());
    const auto answers = *rc::gen::container<std::vector<Joints>>(targets.size(), AnyJoints());
    std::string text;
    for (size_t i = 0; i < targets.size(); ++i) {
      // A comment of another dialect may be no comment here, so what follows is on a new line.
      text += *rc::gen::elementOf(kOther) + "\n";
      text += TargetText(dialect, targets[i], *rc::gen::inRange(0, 3), i);
    }
    const double si = dialect == Dialect::kUrScript ? 1.0 : std::numbers::pi / 180.0;
    std::vector<Joints> asked;
    const auto corrected = CorrectProgram(text, "p", dialect, kSixRevolute,
                                          [&](const std::vector<Joints>& questions) {
                                            asked = questions;
                                            std::vector<CorrectedJoints> result;
                                            for (size_t i = 0; i < questions.size(); ++i) {
                                              result.push_back({answers[i], ""});
                                              for (double& q : result.back().joints) q *= si;
                                            }
                                            return result;
                                          },
                                          {.largest_change_rad = 1e9});
    RC_ASSERT(corrected.ok());
    RC_ASSERT(asked.size() == targets.size());
    const Program again = ReadProgram(corrected->text, dialect, 6);
    for (size_t i = 0; i < targets.size(); ++i) {
      for (size_t j = 0; j < 6; ++j) {
        // A decimal number is read to the last bit; rad to degrees costs two roundings.
        RC_ASSERT(std::abs(asked[i][j] - si * targets[i][j]) <= 1e-15 * std::abs(asked[i][j]));
        const double read = NumberIn(corrected->text, again.targets[i].joints[j]);
        const double half = dialect == Dialect::kUrScript ? 0.5e-8 : 0.5e-6;
        RC_ASSERT(std::abs(read - answers[i][j]) <= half + 1e-12);
      }
    }
  }));
}

// A correction that changes nothing changes no value, in any number of rounds.
TEST_P(RoundTripTest, ASecondRoundChangesNothing) {
  const Dialect dialect = GetParam();
  EXPECT_TRUE(rc::check([&] {
    const auto targets = *rc::gen::container<std::vector<Joints>>(AnyJoints());
    std::string text;
    for (size_t i = 0; i < targets.size(); ++i)
      text += TargetText(dialect, targets[i], *rc::gen::inRange(0, 3), i);
    const auto once = CorrectProgram(text, "p", dialect, kSixRevolute, Unchanged, {});
    RC_ASSERT(once.ok());
    const auto twice = CorrectProgram(once->text, "p", dialect, kSixRevolute, Unchanged, {});
    RC_ASSERT(twice.ok());
    RC_ASSERT(twice->text == once->text);
    RC_ASSERT(twice->changes.size() == targets.size());
  }));
}

INSTANTIATE_TEST_SUITE_P(Dialects, RoundTripTest,
                         ::testing::Values(Dialect::kUrScript, Dialect::kKrl, Dialect::kRapid),
                         [](const auto& test) { return std::string(NameOf(test.param)); });

}  // namespace
}  // namespace truepose::programs
