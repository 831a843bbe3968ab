#include "compensation/kinematics.h"

#include <Eigen/LU>
#include <cmath>

#include "compensation/effects.h"
#include "compensation/frame.h"
#include "compensation/sines.h"
#include "core/geometry/rotation.h"

namespace truepose::compensation {
namespace {

// Six angles at once. @returns false where one is too large for that, or no number.
bool SetSix(const JointChain& chain, const double* q_chain, Motions* motions) {
  bool are_small = true;
  for (int i = 0; i < 6; ++i) are_small &= std::abs(q_chain[i]) <= kLargestAngle;
  if (!are_small) return false;
  double sine[6], cosine[6];
  SinesOfSix(q_chain, sine, cosine);
  for (int i = 0; i < 6; ++i) {
    const bool slides = chain.prismatic[i];
    (*motions)[i] = {slides ? q_chain[i] : cosine[i], slides ? 0 : sine[i]};
  }
  return true;
}

}  // namespace

void SetMotions(const JointChain& chain, const double* q_chain, Motions* motions) noexcept {
  if (chain.joints == 6 && SetSix(chain, q_chain, motions)) return;
  for (int i = 0; i < chain.joints; ++i) {
    if (chain.prismatic[i]) {
      (*motions)[i] = {q_chain[i], 0};
      continue;
    }
    const double cosine = std::cos(q_chain[i]), sine = std::sin(q_chain[i]);  // one call of sincos
    (*motions)[i] = {cosine, sine};
  }
}

void AddSmallStep(const JointChain& chain, const double* step, Motions* motions) noexcept {
  for (int i = 0; i < chain.joints; ++i) {
    JointMotion& motion = (*motions)[i];
    if (chain.prismatic[i]) {
      motion.cosine += step[i];
      continue;
    }
    const double a = step[i], b = a * a;
    const double s = a * (1 - b * (1.0 / 6 - b * (1.0 / 120 - b * (1.0 / 5040))));
    const double c = 1 - b * (0.5 - b * (1.0 / 24 - b * (1.0 / 720)));
    const double cosine = motion.cosine * c - motion.sine * s;
    motion.sine = motion.sine * c + motion.cosine * s;
    motion.cosine = cosine;
  }
}

Pose Forward(const JointChain& chain, const Motions& motions) noexcept {
  Frame frame = FrameOf(chain.constant[0]);
  for (int i = 0; i < chain.joints; ++i) {
    Move(chain.prismatic[i], motions[i], &frame);
    Append(chain.constant[i + 1], &frame);
  }
  return PoseOf(frame);
}

Pose Forward(const JointChain& chain, const double* q_chain) noexcept {
  Motions motions;
  SetMotions(chain, q_chain, &motions);
  return Forward(chain, motions);
}

Pose AfterMotion(const JointChain& chain, const Motions& motions, int joint) noexcept {
  Frame frame = FrameOf(chain.constant[0]);
  for (int i = 0; i < joint; ++i) {
    Move(chain.prismatic[i], motions[i], &frame);
    Append(chain.constant[i + 1], &frame);
  }
  Move(chain.prismatic[joint], motions[joint], &frame);
  return PoseOf(frame);
}

void RunSweep(const JointChain& chain, const Motions& motions, Sweep* sweep) noexcept {
  Frame frame = FrameOf(chain.constant[0]);
  for (int i = 0; i < chain.joints; ++i) {
    sweep->axis[i] = {frame.z, frame.p};
    Move(chain.prismatic[i], motions[i], &frame);
    Append(chain.constant[i + 1], &frame);
  }
  sweep->X_BF = PoseOf(frame);
}

Twist ColumnOf(const JointChain& chain, const Sweep& sweep, int joint) noexcept {
  const Eigen::Vector3d& u = sweep.axis[joint].u;
  Twist column;
  if (chain.prismatic[joint]) {
    column << u, Eigen::Vector3d::Zero();
    return column;
  }
  const Eigen::Vector3d r = sweep.X_BF.p - sweep.axis[joint].p;
  column(0) = u(1) * r(2) - u(2) * r(1);  // u x r by hand: Eigen's goes through memory here
  column(1) = u(2) * r(0) - u(0) * r(2);
  column(2) = u(0) * r(1) - u(1) * r(0);
  column(3) = u(0);
  column(4) = u(1);
  column(5) = u(2);
  return column;
}

Twist Curvature(const JointChain& chain, const Sweep& sweep, const double* step) noexcept {
  Eigen::Vector3d omega = Eigen::Vector3d::Zero(), p = omega, r = omega;
  for (int i = 0; i < chain.joints; ++i) {
    const Eigen::Vector3d& u = sweep.axis[i].u;
    if (chain.prismatic[i]) {
      p += omega.cross(u) * step[i];
      continue;
    }
    const Eigen::Vector3d half = u * (0.5 * step[i]);
    r += omega.cross(half);
    p += (omega + half).cross(u.cross(sweep.X_BF.p - sweep.axis[i].p)) * step[i];
    omega += 2 * half;
  }
  Twist curvature;
  curvature << p, r;
  return curvature;
}

Jacobian JacobianOf(const JointChain& chain, const Sweep& sweep) noexcept {
  Jacobian J(6, chain.joints);
  for (int i = 0; i < chain.joints; ++i) J.col(i) = ColumnOf(chain, sweep, i);
  return J;
}

Twist Remainder(const Pose& desired, const Pose& X_BF) noexcept {
  // sum of r_i x d_i over the columns is 2 sin(angle) axis; the series of asin(s) / s below is
  // right to 1e-15 up to 0.02 rad, beyond which the logarithm takes over.
  const Eigen::Vector3d s =
      0.5 * (X_BF.R.col(0).cross(desired.R.col(0)) + X_BF.R.col(1).cross(desired.R.col(1)) +
             X_BF.R.col(2).cross(desired.R.col(2)));
  const double b = s.squaredNorm();
  const bool small = b < 4e-4 && X_BF.R.cwiseProduct(desired.R).sum() > 1;
  Twist e;
  e.head<3>() = desired.p - X_BF.p;
  if (small) {
    e.tail<3>() = s * (1 + b * (1.0 / 6 + b * (3.0 / 40 + b * (15.0 / 336))));
  } else {
    e.tail<3>() = LogRotation<double>(desired.R * X_BF.R.transpose());
  }
  return e;
}

void ToChain(const Arm& arm, const double* q_controller, double* q_chain) noexcept {
  const int n = arm.nominal.joints;
  for (int i = 0; i < n; ++i) q_chain[i] = arm.joint_offset(i);
  for (int j = 0; j < n; ++j) {
    const double* column = arm.joint_scale.data() + kMaxJoints * j;
    for (int i = 0; i < n; ++i) q_chain[i] += column[i] * q_controller[j];
  }
}

void ToController(const Arm& arm, const double* q_chain, double* q_controller) noexcept {
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxJoints,
                               kMaxJoints>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxJoints, 1>;
  const int n = arm.nominal.joints;
  const Square scale = arm.joint_scale.topLeftCorner(n, n);
  const Vector moved = Eigen::Map<const Eigen::VectorXd>(q_chain, n) - arm.joint_offset.head(n);
  const Vector q = scale.partialPivLu().solve(moved);
  for (int i = 0; i < n; ++i) q_controller[i] = q(i);
}

Pose NominalFlange(const Arm& arm, const double* q) noexcept {
  JointArray q_chain;
  ToChain(arm, q, q_chain.data());
  return Forward(arm.nominal, q_chain.data());
}

Pose IdentifiedFlange(const Arm& arm, const double* q) noexcept {
  JointArray moved, q_chain;
  MovedJoints(arm, q, moved.data());
  ToChain(arm, moved.data(), q_chain.data());
  return Forward(arm.identified, q_chain.data());
}

}  // namespace truepose::compensation
