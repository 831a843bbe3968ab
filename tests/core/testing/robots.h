// Robots that tests of core share, and random numbers for them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/robot/dh.h"
#include "core/robot/robot.h"

namespace truepose::testing {

inline constexpr double kDeg = 0.017453292519943295;

// A robot of a standard D&H table; `types` is a letter a joint, R or P. Aborts on a fault of the
// table.
Robot DhRobot(const std::vector<DhRow>& rows, const std::string& types);

Robot Ur10();
Robot Panda();
Robot Stanford();      // the chapter's Table 3
Robot MeasuringArm();  // the chapter's Sec. 11, Eq. 37 as corrected

// A chain of chapter-notes 1 with the number of identifiable parameters 4R + 2P + 6.
struct CountedRobot {
  std::string name;
  Robot robot;
  int parameters;
};
std::vector<CountedRobot> CountedRobots();

Eigen::VectorXd RandomVector(int size, double range, Random* random);

}  // namespace truepose::testing
