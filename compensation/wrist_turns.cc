#include "compensation/wrist_turns.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace truepose::compensation {
namespace {

constexpr double kStraight = 1e-12;  // rad; a hundredth of what counts as reached: any q4 does
constexpr double kNearlyStraight = 1e-6;
// Of sin^2(delta / 2) sin(alpha) sin(beta), which rounding or a merged pair of places has put
// beyond 0 or 1.
constexpr double kBeyond = 2.5e-5;

Eigen::Matrix3d TurnZ(double q) {
  return Eigen::AngleAxisd(q, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

double DirectionOf(const Eigen::Vector3d& v) { return std::atan2(v.y(), v.x()); }

double AngleToZ(const Eigen::Vector3d& v) { return std::atan2(v.head<2>().norm(), v.z()); }

// delta >= 0, or none: negative.
double AngleAtAxis5(double alpha, double beta, double theta) {
  const double gamma = alpha - beta, sum = alpha + beta;
  const double sine = std::sin((theta + gamma) / 2) * std::sin((theta - gamma) / 2);
  const double cosine = std::sin((sum + theta) / 2) * std::sin((sum - theta) / 2);
  const double beyond = -kBeyond * std::sin(alpha) * std::sin(beta);
  if (!(sine >= beyond && cosine >= beyond)) return -1;
  return 2 * std::atan2(std::sqrt(std::max(sine, 0.0)), std::sqrt(std::max(cosine, 0.0)));
}

class Wrist {
 public:
  Wrist(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B, const Eigen::Matrix3d& M)
      : A_(A), B_(B), M_(M), theta_(AngleToZ(M.col(2))) {}

  WristTurns Turns(double q4_reference) const {
    const Eigen::Vector3d axis_4 = A_.row(2).transpose(), axis_6 = B_.col(2);  // in frames 5
    const double nearest = DirectionOf(axis_4) - DirectionOf(axis_6);
    const double delta = AngleAtAxis5(AngleToZ(axis_4), AngleToZ(axis_6), theta_);
    WristTurns turns;
    if (delta >= 0) Append(nearest + delta, q4_reference, &turns);
    if (delta > 0) Append(nearest - delta, q4_reference, &turns);
    return turns;
  }

 private:
  void Append(double q5, double q4_reference, WristTurns* turns) const {
    const Eigen::Matrix3d K = A_ * TurnZ(q5) * B_;
    const double bent = std::min(theta_, std::numbers::pi - theta_);
    if (bent > kStraight)
      turns->q[turns->count++] = With(DirectionOf(M_.col(2)) - DirectionOf(K.col(2)), q5, K);
    if (bent < kNearlyStraight) turns->q[turns->count++] = With(q4_reference, q5, K);
  }

  std::array<double, 3> With(double q4, double q5, const Eigen::Matrix3d& K) const {
    const Eigen::Matrix3d last = K.transpose() * TurnZ(-q4) * M_;
    return {q4, q5, std::atan2(last(1, 0) - last(0, 1), last(0, 0) + last(1, 1))};
  }

  const Eigen::Matrix3d &A_, &B_, &M_;
  const double theta_;
};

}  // namespace

WristTurns WristTurnsOf(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B,
                        const Eigen::Matrix3d& M, double q4_reference) noexcept {
  return Wrist(A, B, M).Turns(q4_reference);
}

}  // namespace truepose::compensation
