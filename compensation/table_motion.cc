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

inline Pose Times(const Pose& X, const Pose& Y) {
  Pose Z;
  for (int i = 0; i < 3; ++i) Z.R.col(i) = Along(X, Y.R.col(i));
  Z.p = X.p + Along(X, Y.p);
  return Z;
}

// From `X` on by Z_i C[i+1] of the joints from `first` to before `last`.
inline Pose Further(const JointChain& chain, const Motions& motions, int first, int last, Pose X) {
  for (int i = first; i < last; ++i) {
    Move(chain.prismatic[i], motions[i], &X);
    X = Times(X, chain.constant[i + 1]);
  }
  return X;
}

}  // namespace

// In three pieces that do not wait for each other, where the processor can take them together.
Pose CorrectedFlange(const JointChain& chain, const Motions& motions, const Delta& delta) noexcept {
  const int last = chain.joints - 1, middle = last / 2;
  const Pose first = Further(chain, motions, 0, middle, chain.constant[0]);
  const Pose second = Further(chain, motions, middle, last, Pose());
  const Pose third = Further(chain, motions, last, last + 1, PoseOfDelta(delta));
  return Times(first, Times(second, third));
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
