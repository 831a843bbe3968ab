#include "compensation/wrist_turns.h"

#include <Eigen/Geometry>
#include <cmath>

#include "compensation/trigonometric.h"

namespace truepose::compensation {
namespace {

constexpr double kStraight = 1e-9;  // sine of the angle between axes 4 and 6

Eigen::Matrix3d TurnZ(double q) {
  return Eigen::AngleAxisd(q, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

}  // namespace

WristTurns WristTurnsOf(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B,
                        const Eigen::Matrix3d& M, double q4_reference) noexcept {
  const Eigen::Vector3d a = A.row(2).transpose(), b = B.col(2);
  const Roots q5 = RootsOf(Trigonometric{a.z() * b.z() - M(2, 2), a.x() * b.x() + a.y() * b.y(),
                                         a.y() * b.x() - a.x() * b.y()});
  WristTurns turns;
  for (int i = 0; i < q5.count; ++i) {
    const Eigen::Matrix3d K = A * TurnZ(q5.q[i]) * B;
    const bool straight = K.col(2).head<2>().norm() < kStraight;
    const double q4 =
        straight ? q4_reference : std::atan2(M(1, 2), M(0, 2)) - std::atan2(K(1, 2), K(0, 2));
    const Eigen::Matrix3d last = K.transpose() * TurnZ(-q4) * M;
    const double q6 = std::atan2(last(1, 0) - last(0, 1), last(0, 0) + last(1, 1));
    turns.q[turns.count++] = {q4, q5.q[i], q6};
  }
  return turns;
}

}  // namespace truepose::compensation
