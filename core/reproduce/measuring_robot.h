// The chapter's measuring robot (Sec. 11.2) with its own 25 parameters, Eq. 37 as corrected in
// docs/models.md: the chain runs from the instrument G = M to the pin's tip T,
//   M = A_0 A_1 ... A_6
//   A_0 = T(x, X0) T(y, Y0) R(x, chi0) R(y, psi0)                              Eq. 33
//   A_i = R(z, th_i + q_i) T(z, d_i) T(x, a_i) R(x, al_i), i = 1, 3, 4, 5      Eq. 34
//   A_2 = R(z, th_2 + q_2) T(x, a_2) R(x, al_2) R(y, y2)                       Eq. 35, d_2 held
//   A_6 = T(z, Zp)                                                             Eq. 36
// so the frames of base and tool in a Problem stay at the identity. Frame 2 takes d_2 = 0: joint
// axes 2 and 3 are parallel, and d_2 can't be told from d_3.
#pragma once

#include <string>
#include <vector>

#include "core/identification/problem.h"
#include "core/models/model.h"

namespace truepose {

inline constexpr int kMeasuringRobotJoints = 5;

// The parameters are named as in Eq. 37: "X0", "Y0", "chi0", "psi0", "th1", "d1", "a1", "al1" ...
// "th2", "a2", "al2", "y2" ... "Zp".
Model MeasuringRobot();

// Eq. 38: base, joint offsets, link lengths along the arm; 14 names.
const std::vector<std::string>& ReducedSet();
// The other 11, in the order of Eq. 37; Table 8 chooses among them.
const std::vector<std::string>& AdditionalSet();

// Readings of that model; base and tool frames at the identity.
Problem MeasuringRobotProblem(const Model& model, std::vector<Reading> readings);

// Candidate indices of names of the model's parameters.
std::vector<int> CandidatesNamed(const Problem& problem, const std::vector<std::string>& names);

}  // namespace truepose
