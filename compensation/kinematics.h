// Poses and Jacobians of a chain of z joints. Everything is noexcept and allocates nothing.
//
// One sweep multiplies X <- X Z_i(q_i) C[i]. Joint i turns about (moves along) the z axis u_i of
// the frame before it, through that frame's origin p_i, both in B. The flange point then moves with
// u_i x (p_F - p_i) and turns with u_i (Eqs. 26 to 31 carried to the flange point); along a
// prismatic axis it moves with u_i.
#pragma once

#include <Eigen/Core>
#include <array>

#include "compensation/arm.h"
#include "compensation/outcome.h"

namespace truepose::compensation {

using Twist = Eigen::Matrix<double, 6, 1>;  // motion of the flange point; rotation; both in B

// Columns are Twists by the chain's joints.
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, kMaxJoints>;

// cos and sin of a revolute joint; cosine is the length of a prismatic one.
struct JointMotion {
  double cosine = 1, sine = 0;
};
using Motions = std::array<JointMotion, kMaxJoints>;

struct JointAxis {
  Eigen::Vector3d u, p;
};

// X_BF and the axes on the way.
struct Sweep {
  Pose X_BF;
  std::array<JointAxis, kMaxJoints> axis;
};

void SetMotions(const JointChain& chain, const double* q_chain, Motions* motions) noexcept;
// Adds `step` to the joints by the theorem of addition: no sines for steps below 0.03 rad, then
// right to 1e-15. The caller keeps larger ones out.
inline constexpr double kLongestSmallStep = 0.03;
void AddSmallStep(const JointChain& chain, const double* step, Motions* motions) noexcept;

Pose Forward(const JointChain& chain, const Motions& motions) noexcept;
Pose Forward(const JointChain& chain, const double* q_chain) noexcept;
// The frame that moves with `joint`, before what is constant behind it.
Pose AfterMotion(const JointChain& chain, const Motions& motions, int joint) noexcept;
void RunSweep(const JointChain& chain, const Motions& motions, Sweep* sweep) noexcept;
Twist ColumnOf(const JointChain& chain, const Sweep& sweep, int joint) noexcept;
// The second-order part of the motion by `step` (chain joints): X moves by J step + Curvature +
// O(step^3). With w_i = sum_{j<i} u_j step_j the displacement is
// sum_i step_i (w_i + u_i step_i / 2) x (u_i x (p_F - p_i)), the rotation vector
// sum_i step_i w_i x u_i / 2.
Twist Curvature(const JointChain& chain, const Sweep& sweep, const double* step) noexcept;
Jacobian JacobianOf(const JointChain& chain, const Sweep& sweep) noexcept;

// What is left to do at X_BF: displacement of the flange point and rotation vector of
// R_desired R^T, both in B.
Twist Remainder(const Pose& desired, const Pose& X_BF) noexcept;

// q_chain = joint_scale q + joint_offset, and back.
void ToChain(const Arm& arm, const double* q_controller, double* q_chain) noexcept;
void ToController(const Arm& arm, const double* q_chain, double* q_controller) noexcept;

// X_BF at controller joints: as the controller believes, and as it is.
Pose NominalFlange(const Arm& arm, const double* q) noexcept;
Pose IdentifiedFlange(const Arm& arm, const double* q) noexcept;

}  // namespace truepose::compensation
