#include "compensation/table_motion.h"

#include <algorithm>

#include "compensation/frame.h"

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

// Further by the constant i of the nominal chain.
[[gnu::always_inline]] inline void Append(const Table& table, int i, Frame* frame) {
  const Pose& C = table.arm.nominal.constant[i];
  frame->p += Along(*frame, C.p);
  switch (table.turn[i]) {
    case Turn::kNone:
      return;
    case Turn::kQuarter:
      frame->y.swap(frame->z);
      frame->z = -frame->z;
      return;
    case Turn::kMinusQuarter:
      frame->y.swap(frame->z);
      frame->y = -frame->y;
      return;
    case Turn::kGeneral:
      Rotate(C.R, frame);
  }
}

}  // namespace

Pose CorrectedFlange(const Table& table, const Motions& motions, const Delta& delta) noexcept {
  const JointChain& chain = table.arm.nominal;
  const int last = chain.joints - 1;
  Frame frame = FrameOf(chain.constant[0]);
  for (int i = 0; i < last; ++i) {
    Move(chain.prismatic[i], motions[i], &frame);
    Append(table, i + 1, &frame);
  }
  Append(PoseOfDelta(delta), &frame);
  Move(chain.prismatic[last], motions[last], &frame);
  Append(table, last + 1, &frame);
  return PoseOf(frame);
}

void SweepTable(const Table& table, const Motions& motions, TableSweep* sweep) noexcept {
  const JointChain& chain = table.arm.nominal;
  Frame frame = FrameOf(chain.constant[0]);
  for (int i = 0; i < chain.joints; ++i) {
    sweep->axis[i] = {frame.z, frame.p};
    if (i + 1 == chain.joints) sweep->X_BL = PoseOf(frame);
    Move(chain.prismatic[i], motions[i], &frame);
    Append(table, i + 1, &frame);
  }
  sweep->X_BF = PoseOf(frame);
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
