#include "core/compensation/pose_finder.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "compensation/kinematics.h"

namespace truepose {
namespace {

using compensation::Arm;
using compensation::Jacobian;
using compensation::Twist;

// Steps of the way from place to place are this short, so that Newton stays on its branch.
constexpr double kStep_m = 0.1, kStep_rad = 0.2;
// A joint that moves farther than this in one such step is at a singularity: 1 rad in 0.1 m is
// what a wrist does 0.1 rad from its own.
constexpr double kFarthest = 1.0;
constexpr int kIterations = 10;
constexpr double kReached = 1e-6;          // m, rad: ranges of joints need no more
constexpr double kNearlyReached = 1e-3;    // m, of an arm with fewer than six joints
constexpr double kMetresPerRadian = 1e-3;  // weight of the orientation that such an arm can't meet
constexpr double kSmallStep = 1e-4;        // rad or m: more changes no range of joints
constexpr double kDamping = 1e-9;
constexpr double kFewDamping = 1e-12;  // far below the weight of orientations, its square 1e-6

// A place this many steps or less from one that is kept is not kept itself.
constexpr double kSpacing = 2;

// What is asked of the flange, in B: Newton's equations for a step of the joints.
struct Equations {
  Jacobian J;
  Twist remainder;
};

Equations EquationsAt(const Arm& arm, const Pose& X_BF, const JointVector& q) {
  compensation::Motions motions;
  compensation::Sweep sweep;
  SetMotions(arm.nominal, q.data(), &motions);
  RunSweep(arm.nominal, motions, &sweep);
  return {JacobianOf(arm.nominal, sweep), compensation::Remainder(X_BF, sweep.X_BF)};
}

JointVector StepOfSixAndMore(const Equations& equations) {
  const Jacobian& J = equations.J;
  Eigen::Matrix<double, 6, 6> normal = J.lazyProduct(J.transpose());
  normal.diagonal().array() += kDamping * normal.diagonal().maxCoeff();
  const Twist y = normal.ldlt().solve(equations.remainder);
  return J.transpose().lazyProduct(y);
}

// Position first; of the orientation what is not about the tool's axis z_B.
JointVector StepOfFew(Equations equations, const Eigen::Vector3d& z_B) {
  const Eigen::Matrix3d across =
      kMetresPerRadian * (Eigen::Matrix3d::Identity() - z_B * z_B.transpose());
  equations.J.bottomRows<3>() = across * equations.J.bottomRows<3>();
  equations.remainder.tail<3>() = across * equations.remainder.tail<3>();
  JointMatrix normal = equations.J.transpose().lazyProduct(equations.J);
  normal.diagonal().array() += kFewDamping * normal.diagonal().maxCoeff();
  const JointVector b = equations.J.transpose() * equations.remainder;
  return normal.ldlt().solve(b);
}

bool Arrived(const Twist& remainder, const JointVector& step) {
  if (step.size() >= 6) return remainder.cwiseAbs().maxCoeff() < kReached;
  return remainder.head<3>().norm() < kNearlyReached && step.cwiseAbs().maxCoeff() < kSmallStep;
}

// From joints nearby to those of X_BF; nothing when they don't arrive or run away.
std::optional<JointVector> Solve(const Arm& arm, const Pose& X_BF, const Eigen::Vector3d& axis_F,
                                 const JointVector& q_start) {
  JointVector q = q_start;
  for (int i = 0; i < kIterations; ++i) {
    const Equations equations = EquationsAt(arm, X_BF, q);
    const JointVector step =
        q.size() < 6 ? StepOfFew(equations, X_BF.R * axis_F) : StepOfSixAndMore(equations);
    if (Arrived(equations.remainder, step)) return q;
    q += step;
    if (!((q - q_start).cwiseAbs().maxCoeff() <= kFarthest)) return std::nullopt;
  }
  return std::nullopt;
}

double StepsBetween(const Place& a, const Place& b) {
  const Place d = b - a;
  return std::max(d.head<3>().norm() / kStep_m, d.tail<3>().norm() / kStep_rad);
}

}  // namespace

Places::Places(const Arm& arm, const BoxDomain& box) : X_TF_(Inverse(box.X_FT)) {
  const Eigen::Vector3d approach = box.approach_B.normalized();
  across_.col(0) = approach.unitOrthogonal();
  across_.col(1) = approach.cross(across_.col(0));
  const Pose X_BT = compensation::NominalFlange(arm, box.reference.data()) * box.X_FT;
  const Eigen::Vector3d z = X_BT.R.col(2);
  const Eigen::Matrix3d tilt = Eigen::Quaterniond::FromTwoVectors(approach, z).toRotationMatrix();
  R_0_ = tilt.transpose() * X_BT.R;
  start_ << X_BT.p, across_.transpose() * LogRotation<double>(tilt), 0;
}

Pose Places::FlangeAt(const Place& place) const {
  const Eigen::Vector3d tilt = across_ * place.segment<2>(3), roll(0, 0, place(5));
  return Pose{ExpRotation<double>(tilt) * R_0_ * ExpRotation<double>(roll), place.head<3>()} *
         X_TF_;
}

PoseFinder::PoseFinder(const Arm& arm, const BoxDomain& box)
    : arm_(arm),
      places_(arm, box),
      axis_F_(box.X_FT.R.col(2)),
      chain_(arm, JointMatrix::Identity(arm.nominal.joints, arm.nominal.joints)),
      reached_{{places_.start(), chain_.FromController(box.reference)}} {}

std::optional<JointVector> PoseFinder::Reach(const Place& place) {
  Place wanted = place;
  if (chain_.joints() < 6) wanted(5) = 0;
  const Reached& nearest = NearestTo(wanted);
  const std::optional<JointVector> q = Follow(nearest, wanted);
  if (!q) return std::nullopt;
  Keep(nearest, {wanted, *q});  // also beyond a limit: from there the way may lead back
  return WithinLimits(*q) ? q : std::nullopt;
}

// Few are enough to begin from, and every place is compared with all of them.
void PoseFinder::Keep(const Reached& nearest, const Reached& reached) {
  if (StepsBetween(nearest.place, reached.place) > kSpacing) reached_.push_back(reached);
}

const PoseFinder::Reached& PoseFinder::NearestTo(const Place& place) const {
  size_t nearest = 0;
  double steps = HUGE_VAL;
  for (size_t i = 0; i < reached_.size(); ++i) {
    const double to_it = StepsBetween(reached_[i].place, place);
    if (to_it >= steps) continue;
    nearest = i;
    steps = to_it;
  }
  return reached_[nearest];
}

std::optional<JointVector> PoseFinder::Follow(const Reached& from, const Place& to) const {
  const int steps = std::max(1, static_cast<int>(std::ceil(StepsBetween(from.place, to))));
  std::optional<JointVector> q = from.q;
  for (int i = 1; i <= steps && q; ++i) {
    const Place place = from.place + (to - from.place) * i / steps;
    q = Solve(arm_, places_.FlangeAt(place), axis_F_, *q);
  }
  return q;
}

bool PoseFinder::WithinLimits(const JointVector& q_chain) const {
  const JointVector q = chain_.ToController(q_chain);
  for (int i = 0; i < q.size(); ++i) {
    const compensation::JointLimits& limits = arm_.limits[static_cast<size_t>(i)];
    if (q(i) < limits.lower || q(i) > limits.upper) return false;
  }
  return true;
}

}  // namespace truepose
