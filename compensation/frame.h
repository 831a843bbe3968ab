// A frame on its way along a chain, X <- X Z_i(q_i) C[i]. Always inline: its vectors then stay in
// registers from joint to joint, which is a tenth of a correction's time.
#pragma once

#include <Eigen/Core>

#include "compensation/kinematics.h"

namespace truepose::compensation {

struct Frame {
  Eigen::Vector3d x, y, z, p;
};

[[gnu::always_inline]] inline Frame FrameOf(const Pose& X) noexcept {
  return {X.R.col(0), X.R.col(1), X.R.col(2), X.p};
}

[[gnu::always_inline]] inline Pose PoseOf(const Frame& frame) noexcept {
  Pose X;
  X.R << frame.x, frame.y, frame.z;
  X.p = frame.p;
  return X;
}

// Of a joint.
[[gnu::always_inline]] inline void Move(bool prismatic, const JointMotion& motion,
                                        Frame* frame) noexcept {
  if (prismatic) {
    frame->p += frame->z * motion.cosine;
    return;
  }
  const Eigen::Vector3d x = frame->x * motion.cosine + frame->y * motion.sine;
  frame->y = frame->y * motion.cosine - frame->x * motion.sine;
  frame->x = x;
}

// v of the frame's own axes, in B.
[[gnu::always_inline]] inline Eigen::Vector3d Along(const Frame& frame,
                                                    const Eigen::Vector3d& v) noexcept {
  return frame.x * v(0) + frame.y * v(1) + frame.z * v(2);
}

[[gnu::always_inline]] inline void Rotate(const Eigen::Matrix3d& R, Frame* frame) noexcept {
  const Eigen::Vector3d x = Along(*frame, R.col(0)), y = Along(*frame, R.col(1));
  frame->z = Along(*frame, R.col(2));
  frame->x = x;
  frame->y = y;
}

[[gnu::always_inline]] inline void Append(const Pose& constant, Frame* frame) noexcept {
  frame->p += Along(*frame, constant.p);
  Rotate(constant.R, frame);
}

}  // namespace truepose::compensation
