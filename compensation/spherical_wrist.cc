#include "compensation/spherical_wrist.h"

#include <cmath>
#include <numbers>

#include "compensation/wrist_placement.h"
#include "compensation/wrist_turns.h"

namespace truepose::compensation {
namespace {

constexpr double kMeeting = 1e-7;   // m; data sheets give lengths to 1e-5
constexpr double kParallel = 1e-6;  // sine of the angle between axes that count as parallel

// Where the z axis of a frame and that of the frame C in it come nearest: heights over the two
// origins.
struct Meeting {
  bool meet = false;
  double first = 0, second = 0;
};

Meeting MeetingOf(const Pose& C) {
  const Eigen::Vector3d u = C.R.col(2);
  const double squared = u.head<2>().squaredNorm();
  if (squared < kParallel * kParallel) return {};
  const double t = -C.p.head<2>().dot(u.head<2>()) / squared;
  const Eigen::Vector3d p = C.p + t * u;
  return {p.head<2>().norm() <= kMeeting, p.z(), t};
}

bool LastThreeTurn(const JointChain& chain) {
  return chain.joints == 6 && !chain.prismatic[3] && !chain.prismatic[4] && !chain.prismatic[5];
}

void Append(const JointChain& chain, const std::array<double, 3>& placement,
            const std::array<double, 3>& turns, WristBranches* branches) {
  if (branches->count == kMaxWristBranches) return;
  JointArray& q = branches->q[branches->count++];
  for (int i = 0; i < 6; ++i) {
    const double joint = i < 3 ? placement[i] : turns[i - 3];
    q[i] = chain.prismatic[i] ? joint : std::remainder(joint, 2 * std::numbers::pi);
  }
}

// Of the frame before joint 4 in B.
Eigen::Matrix3d RotationBefore4(const JointChain& chain, const std::array<double, 3>& placement) {
  const JointArray q = {placement[0], placement[1], placement[2]};
  Motions motions;
  SetMotions(chain, q.data(), &motions);
  return AfterMotion(chain, motions, 2).R * chain.constant[3].R;
}

}  // namespace

SphericalWrist SphericalWristOf(const JointChain& chain) noexcept {
  SphericalWrist wrist;
  if (!LastThreeTurn(chain)) return wrist;
  const Meeting of_45 = MeetingOf(chain.constant[4]), of_56 = MeetingOf(chain.constant[5]);
  if (!of_45.meet || !of_56.meet || std::abs(of_45.second - of_56.first) > kMeeting) return wrist;
  wrist.centre_3 = chain.constant[3] * Eigen::Vector3d(0, 0, of_45.first);
  wrist.centre_F = Inverse(chain.constant[6]) * Eigen::Vector3d(0, 0, of_56.second);
  wrist.is_one = CanPlace(chain, wrist.centre_3);
  return wrist;
}

WristBranches WristCandidates(const JointChain& chain, const SphericalWrist& wrist,
                              const Pose& X_BF, const double* q_reference) noexcept {
  WristBranches branches;
  const auto& C = chain.constant;
  const Eigen::Vector3d w = Inverse(C[0]) * Eigen::Vector3d(X_BF * wrist.centre_F);
  const Eigen::Matrix3d before_C6 = X_BF.R * C[6].R.transpose();
  const Placements places = PlacementsOf(chain, wrist.centre_3, w, q_reference);
  for (int i = 0; i < places.count; ++i) {
    const Eigen::Matrix3d M = RotationBefore4(chain, places.q[i]).transpose() * before_C6;
    const WristTurns turns = WristTurnsOf(C[4].R, C[5].R, M, q_reference[3]);
    for (int k = 0; k < turns.count; ++k) Append(chain, places.q[i], turns.q[k], &branches);
  }
  return branches;
}

}  // namespace truepose::compensation
