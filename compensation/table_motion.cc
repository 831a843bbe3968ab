#include "compensation/table_motion.h"

#include <algorithm>

namespace truepose::compensation {

Pose PoseOfDelta(const Delta& delta) noexcept {
  const Eigen::Vector3d r = delta.tail<3>();
  const double s = r.squaredNorm();
  Pose E;
  E.p = delta.head<3>();
  if (s < 4e-4) {
    // Series of sin and cos of half the angle; the next terms are below 1e-16.
    Eigen::Vector4d q;
    q << r * (0.5 - s * (1.0 / 48 - s * (1.0 / 3840))),
        1 - s * (1.0 / 8 - s * (1.0 / 384 - s * (1.0 / 46080)));
    E.R = RotationOf<double>(q);
  } else {
    E.R = ExpRotation<double>(r);
  }
  return E;
}

namespace {

inline void Move(bool prismatic, const JointMotion& motion, Pose* X) {
  if (prismatic) {
    X->p += X->R.col(2) * motion.cosine;
    return;
  }
  const Eigen::Vector3d x = X->R.col(0) * motion.cosine + X->R.col(1) * motion.sine;
  X->R.col(1) = X->R.col(1) * motion.cosine - X->R.col(0) * motion.sine;
  X->R.col(0) = x;
}

inline Eigen::Vector3d Along(const Pose& X, const Eigen::Vector3d& v) {
  return X.R.col(0) * v(0) + X.R.col(1) * v(1) + X.R.col(2) * v(2);
}

inline Eigen::Matrix3d Turned(const Pose& X, const Eigen::Matrix3d& R) {
  Eigen::Matrix3d turned;
  for (int i = 0; i < 3; ++i) turned.col(i) = Along(X, R.col(i));
  return turned;
}

// X further by the constant i of the nominal chain.
inline void Append(const Table& table, int i, Pose* X) {
  const Pose& C = table.arm.nominal.constant[i];
  X->p += Along(*X, C.p);
  switch (table.turn[i]) {
    case Turn::kNone:
      return;
    case Turn::kQuarter:
      X->R.col(1).swap(X->R.col(2));
      X->R.col(2) = -X->R.col(2);
      return;
    case Turn::kMinusQuarter:
      X->R.col(1).swap(X->R.col(2));
      X->R.col(1) = -X->R.col(1);
      return;
    case Turn::kGeneral:
      X->R = Turned(*X, C.R);
  }
}

}  // namespace

Pose CorrectedFlange(const Table& table, const Motions& motions, const Delta& delta) noexcept {
  const JointChain& chain = table.arm.nominal;
  const int last = chain.joints - 1;
  Pose X = chain.constant[0];
  for (int i = 0; i < last; ++i) {
    Move(chain.prismatic[i], motions[i], &X);
    Append(table, i + 1, &X);
  }
  const Pose E = PoseOfDelta(delta);
  X = {Turned(X, E.R), X.p + Along(X, E.p)};
  Move(chain.prismatic[last], motions[last], &X);
  Append(table, last + 1, &X);
  return X;
}

void SweepTable(const Table& table, const Motions& motions, TableSweep* sweep) noexcept {
  const JointChain& chain = table.arm.nominal;
  Pose X = chain.constant[0];
  for (int i = 0; i < chain.joints; ++i) {
    sweep->axis[i] = {X.R.col(2), X.p};
    if (i + 1 == chain.joints) sweep->X_BL = X;
    Move(chain.prismatic[i], motions[i], &X);
    Append(table, i + 1, &X);
  }
  sweep->X_BF = X;
}

void ChainJoints(const Table& table, const double* q_controller, double* q_chain) noexcept {
  if (table.plain_joints) {
    std::copy_n(q_controller, table.header.joints, q_chain);
  } else {
    ToChain(table.arm, q_controller, q_chain);
  }
}

void ControllerJoints(const Table& table, const double* q_chain, double* q_controller) noexcept {
  const int n = table.header.joints;
  for (int i = 0; i < n; ++i) {
    q_controller[i] = 0;
    for (int j = 0; j < n; ++j) {
      q_controller[i] +=
          table.controller_from_chain(i, j) * (q_chain[j] - table.arm.joint_offset(j));
    }
  }
}

}  // namespace truepose::compensation
