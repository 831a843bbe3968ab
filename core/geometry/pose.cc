#include "core/geometry/pose.h"

namespace truepose {

Pose AlignPoints(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  const Eigen::Vector3d mean_a = a.rowwise().mean(), mean_b = b.rowwise().mean();
  const Eigen::Matrix3d covariance = (a.colwise() - mean_a) * (b.colwise() - mean_b).transpose();
  const Eigen::Matrix3d R_AB = NearestRotation(covariance);
  return {R_AB, mean_a - R_AB * mean_b};
}

}  // namespace truepose
