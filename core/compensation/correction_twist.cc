#include "core/compensation/correction_twist.h"

namespace truepose {
namespace {

using compensation::Arm;

// Z_n(q_n) C[n].
Pose LastLink(const Arm& arm, double q_last_chain) {
  const auto last = static_cast<size_t>(arm.nominal.joints - 1);
  Pose X_LZ;
  if (arm.nominal.prismatic[last])
    X_LZ.p.z() = q_last_chain;
  else
    X_LZ.R = Eigen::AngleAxisd(q_last_chain, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return X_LZ * arm.nominal.constant[last + 1];
}

}  // namespace

Twist CorrectionTwist(const Arm& arm, const double* q) {
  std::array<double, compensation::kMaxJoints> q_chain;
  compensation::ToChain(arm, q, q_chain.data());
  const Pose X_LF = LastLink(arm, q_chain[static_cast<size_t>(arm.nominal.joints - 1)]);
  const Pose X_FL = Inverse(X_LF);
  const Pose X_BL = compensation::NominalFlange(arm, q) * X_FL;
  const Pose E = Inverse(X_BL) * compensation::IdentifiedFlange(arm, q) * X_FL;
  Twist twist;
  twist << E.p, LogRotation<double>(E.R);
  return twist;
}

Eigen::Vector3d FlangeInL(const Arm& arm, double q_last_chain) {
  return LastLink(arm, q_last_chain).p;
}

}  // namespace truepose
