// Arms with a spherical wrist behind three joints of any types.
#pragma once

#include <string>
#include <vector>

#include "compensation/arm.h"
#include "core/base/random.h"
#include "core/robot/dh.h"

namespace truepose::testing {

// The nominal arm of a robot, without errors.
compensation::Arm NominalArm(const Robot& robot);

// First three rows of D&H, whose joints are of `types` (three letters, R or P); the wrist 0.43 m
// behind along axis 4, its axes at `wrist_angle` (rad) to each other.
compensation::Arm DhWristArm(std::vector<DhRow> rows, const std::string& types, double wrist_angle);

std::vector<DhRow> PumaRows();

// Constants of any direction and of 0.2 to 0.5 m between all joints, the wrist's axes meeting at
// angles of 0.6 to 2.5 rad. Without limits.
compensation::Arm RandomWristArm(const std::string& types, Random* random);

// RRR, RRP, ... PPP.
std::vector<std::string> AllTypesOfThree();

}  // namespace truepose::testing
