#include "core/robot/gravity.h"

namespace truepose {
namespace {

constexpr double kGravity = 9.80665;  // m / s^2, standard

// The chain up to and with the motion of a joint.
Chain Upto(const Chain& chain, int joint) {
  Chain part;
  for (ElementaryTransform element : chain) {
    element.parameter = -1;
    part.push_back(element);
    if (element.joint == joint) break;
  }
  return part;
}

}  // namespace

Eigen::VectorXd GravityLoad(const Chain& chain, const std::vector<LinkMass>& masses,
                            const Eigen::VectorXd& q) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(q.size());
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(q.size());
  Sweep sweep;
  for (const LinkMass& mass : masses) {
    const Chain part = Upto(chain, mass.joint);
    const Pose home = Forward<double>(part, zero.data(), nullptr);
    RunSweep(part, q.data(), nullptr, &sweep);
    const Eigen::Vector3d p = sweep.X_0E * (Inverse(home) * mass.centre_B);
    for (Eigen::Index j = 0; j < sweep.J_joints.cols(); ++j)
      load(j) -= mass.mass_kg * kGravity * TwistAt(p, sweep.J_joints.col(j))(2);
  }
  return load;
}

}  // namespace truepose
