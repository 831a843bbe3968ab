#include "core/export/joint_frames.h"

#include <Eigen/Geometry>
#include <cmath>

namespace truepose {
namespace {

// Of a unit vector; below it another direction keeps more digits.
constexpr double kTooShort = 0.1;

Eigen::Vector3d Across(const Eigen::Vector3d& v, const Eigen::Vector3d& u) {
  return v - u * u.dot(v);
}

// What cosines and sines of quarter turns leave where a data sheet has 0.
double WithoutNoise(double angle) { return std::abs(angle) < 1e-15 ? 0 : angle; }

}  // namespace

Pose FrameOn(const JointAxis& axis, const Pose& X_BN) {
  Eigen::Vector3d x = Across(X_BN.R.col(0), axis.u);
  if (x.norm() < kTooShort) x = Across(X_BN.R.col(2), axis.u);
  x.normalize();
  Pose X;
  X.R << x, axis.u.cross(x), axis.u;
  X.p = X_BN.p;
  if (axis.type == JointType::kRevolute) X.p = axis.p + axis.u * axis.u.dot(X_BN.p - axis.p);
  return X;
}

std::vector<Pose> FramesAlong(const Home& home) {
  std::vector<Pose> frames;
  Pose X;
  for (const JointAxis& axis : home.axes) {
    X = FrameOn(axis, X);
    frames.push_back(X);
  }
  return frames;
}

std::vector<Pose> PosesBetween(const std::vector<Pose>& frames, const Pose& X_BF) {
  std::vector<Pose> between;
  Pose X_B;
  for (const Pose& X : frames) {
    between.push_back(Inverse(X_B) * X);
    X_B = X;
  }
  between.push_back(Inverse(X_B) * X_BF);
  return between;
}

RollPitchYaw RollPitchYawOf(const Eigen::Matrix3d& R) {
  const double yaw = WithoutNoise(std::atan2(R(1, 0), R(0, 0)));
  const double c = std::cos(yaw), s = std::sin(yaw);
  // What is left behind R(z, yaw) fixes the other two whatever yaw was taken.
  return {WithoutNoise(std::atan2(s * R(0, 2) - c * R(1, 2), c * R(1, 1) - s * R(0, 1))),
          WithoutNoise(std::atan2(-R(2, 0), c * R(0, 0) + s * R(1, 0))), yaw};
}

}  // namespace truepose
