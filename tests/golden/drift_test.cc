// How often a drift check is right: alarms without a change, parts named with one. A robot, its
// noisy calibration of 60 poses, gears that no parameter explains, a new instrument noise in each
// seed; then on the measured UR10, which nobody touched between the rows of its series C.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "core/drift/drift_check.h"
#include "tests/core/testing/robots.h"
#include "tests/core/testing/ur10_series.h"
#include "tests/golden/drift_simulation.h"
#include "tests/golden/long_run.h"

namespace truepose {
namespace {

using testing::DriftDesign;
using testing::DriftSimulation;

// What the issue asks for is had from this many poses on (the table in docs/drift.md).
constexpr int kEnoughPoses = 20;

DriftCheckResult MustCheck(const DriftProblem& problem) {
  const auto result = CheckDrift(problem);
  EXPECT_TRUE(result.ok()) << result.status();
  return result.ok() ? *result : DriftCheckResult();
}

// 5 % of alarms allowed, and 3 standard deviations of luck with fewer draws than 200.
int MostAlarms(int checks) {
  return checks >= 200 ? checks / 20 : checks / 20 + static_cast<int>(3 * std::sqrt(0.05 * checks));
}

// Would catch a test that takes the calibration for exact, or unexplained residuals for normal.
TEST(Drift, NoChangeRaisesFewAlarms) {
  const int checks = testing::Draws(20, 200);
  int alarms = 0;
  for (int seed = 1; seed <= checks; ++seed) {
    DriftSimulation robot({}, static_cast<uint64_t>(seed));
    alarms += MustCheck(robot.Check(kEnoughPoses)).changed;
  }
  std::printf("%d alarms in %d checks without change\n", alarms, checks);
  EXPECT_LE(alarms, MostAlarms(checks));
}

// 0.02 deg of joints 2 to 5, 0.5 mm of base and of tool: rightly named in 90 %, in the short form
// 80 % (5 draws are few).
TEST(Drift, EachPartIsNamed) {
  const int checks = testing::Draws(5, 200);
  for (const std::string& part : DriftSimulation::Parts()) {
    int named = 0;
    for (int seed = 1; seed <= checks; ++seed) {
      DriftSimulation robot({}, static_cast<uint64_t>(seed));
      robot.Change(part);
      named += MustCheck(robot.Check(kEnoughPoses)).attributed_to == part;
    }
    std::printf("%s: named in %d of %d\n", part.c_str(), named, checks);
    EXPECT_GE(named, checks >= 200 ? 0.9 * checks : 0.8 * checks) << part;
  }
}

// The table of docs/drift.md: rightly named shares by number of poses, frames held or not. Alarms
// without change stay few for any number.
TEST(Drift, TableOfPoses) {
  const int checks = testing::Draws(2, 200);
  const std::vector<int> poses =
      checks > 2 ? std::vector<int>{6, 10, 15, 20, 30, 40} : std::vector<int>{10, 30};
  for (bool held : {true, false}) {
    std::map<std::string, std::map<int, int>> right;
    for (int seed = 1; seed <= checks; ++seed) {
      for (const std::string part : {"", "base or joint 1", "joint 2", "joint 3", "joint 4",
                                     "joint 5", "tool or last joint"}) {
        if (!held && (part[0] == 'b' || part[0] == 't')) continue;
        DriftSimulation robot({}, static_cast<uint64_t>(seed));
        robot.Change(part);
        for (int n : poses) {
          const DriftCheckResult result = MustCheck(robot.Check(n, held, held));
          right[part][n] += part.empty() ? result.changed : result.attributed_to == part;
        }
      }
    }
    std::printf("%s, of %d\n", held ? "base and tool held" : "base and tool fitted", checks);
    for (const auto& [part, of] : right) {
      std::printf("%-24s", part.empty() ? "alarms without change" : part.c_str());
      for (const auto& [n, count] : of) std::printf("  %d: %3d", n, count);
      std::printf("\n");
    }
    for (int n : poses) EXPECT_LE(right[""][n], MostAlarms(checks)) << n;
  }
}

// Poses that all stand near one place, where the slow part of the unexplained residual is the same
// for all: its mean there looks like a motion of base or tool, and must not count as one.
TEST(Drift, PosesInOneCorner) {
  const int checks = testing::Draws(10, 100);
  int alarms = 0;
  for (int seed = 1; seed <= checks; ++seed) {
    DriftSimulation robot({}, 2000 + static_cast<uint64_t>(seed));
    const Eigen::VectorXd corner = robot.home() + Eigen::VectorXd::Constant(6, 0.5);
    alarms += MustCheck(robot.CheckWithin(20, corner, 0.05)).changed;
  }
  std::printf("%d alarms in %d checks in a corner\n", alarms, checks);
  EXPECT_LE(alarms, MostAlarms(checks));
}

// The measured UR10 of series C: calibrated from 100 rows, checked with others. 6 % of alarms at
// most in 100 (the unexplained 0.5 mm has long tails), and 3 sd of luck. Then the same rows as if
// joint 3 had slipped by 0.05 deg.
TEST(Drift, MeasuredRobotThatWasLeftAlone) {
  const std::vector<Reading> rows = testing::LoadUr10CalibrationHalf("C");
  const Robot robot = testing::Ur10();
  Random random(1);
  const auto pick = [&](int parity, int count) {
    std::vector<Reading> chosen;
    while (static_cast<int>(chosen.size()) < count) {
      const Reading& row = rows[random.Below(rows.size())];
      const bool is_new = std::none_of(chosen.begin(), chosen.end(),
                                       [&](const Reading& other) { return other.id == row.id; });
      if (row.id / 2 % 2 == parity && is_new) chosen.push_back(row);
    }
    return chosen;
  };
  CalibrationProblem problem;
  problem.robot = &robot;
  problem.readings = pick(0, 100);
  problem.calibrates.assign(100, true);
  problem.placements = problem.targets = {""};
  problem.X_FT_nominal = testing::Ur10Target();
  const auto calibration = Calibrate(problem, {}, {});
  ASSERT_TRUE(calibration.ok()) << calibration.status();
  const int checks = testing::Draws(20, 100);
  int alarms = 0, named = 0;
  for (int i = 0; i < checks; ++i) {
    std::vector<Reading> check = pick(1, 30);
    alarms += MustCheck(testing::DriftProblemOf(robot, *calibration, check)).changed;
    for (Reading& reading : check) reading.q(2) -= 0.05 * testing::kDeg;
    const auto slipped = MustCheck(testing::DriftProblemOf(robot, *calibration, check));
    named += slipped.attributed_to == "joint 3";
  }
  std::printf("series C: %d alarms, joint 3 named in %d of %d\n", alarms, named, checks);
  EXPECT_LE(alarms, static_cast<int>(0.06 * checks + 3 * std::sqrt(0.06 * checks)));
  EXPECT_GE(named, 0.9 * checks);
}

}  // namespace
}  // namespace truepose
