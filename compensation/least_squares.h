// The slow and safe way: joints of any arm by damped least squares (Levenberg-Marquardt).
//
// Minimises |W e(v)|^2 with e the remainder at X(v) = chain(joint_scale v + joint_offset) in the
// frame of the desired flange: displacement R_d^T (p_d - p) of the point `point_F`, and rotation
// vector R_d^T log(R_d R^T). Prismatic joints count as length / length_m in the damping. With six
// free joints or more steps are those of least change; the end can be drawn to the solution nearest
// to a reference.
#pragma once

#include "compensation/kinematics.h"

namespace truepose::compensation {

struct LeastSquaresTask {
  const Arm* arm = nullptr;
  const JointChain* chain = nullptr;  // the arm's nominal or identified one
  Pose desired;
  Eigen::Vector3d point_F = Eigen::Vector3d::Zero();
  Twist weight = Twist::Ones();
  double length_m = 1;
  double position_tolerance_m = 1e-10;
  double rotation_tolerance_rad = 1e-10;
  int max_iterations = 100;
  std::array<bool, kMaxJoints> held{};  // controller joints that stay as they are
};

struct LeastSquaresResult {
  JointArray v{};  // controller joints as moved
  int iterations = 0;
  bool reached = false;         // remainder within both tolerances
  bool settled = false;         // reached, or steps have become nothing: a least remainder
  double cost = 0;              // |W e|
  double position_error_m = 0;  // of point_F
  double rotation_error_rad = 0;
};

LeastSquaresResult SolveLeastSquares(const LeastSquaresTask& task, const double* start) noexcept;

// Of a reached result with more than six free joints: the solution nearest to `reference` within
// the null space, |v - reference| with lengths over length_m least. @returns `result` as it is when
// the way there does not settle.
LeastSquaresResult DrawTowards(const LeastSquaresTask& task, const double* reference,
                               const LeastSquaresResult& result) noexcept;

}  // namespace truepose::compensation
