#include "compensation/spherical_wrist.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compensation/singularity.h"
#include "compensation/trigonometric.h"

namespace truepose::compensation {
namespace {

constexpr double kMeeting = 1e-7;   // m; data sheets give lengths to 1e-5
constexpr double kParallel = 1e-6;  // sine of the angle between axes that count as parallel
constexpr double kOnAxis = 1e-9;    // of the characteristic length: nothing turns the point
// How far beyond 1 a cosine may be that rounding or a merged pair of roots has put there.
constexpr double kBeyondOne = 5e-5;

using Plane = Eigen::Vector2d;

double AngleOf(const Plane& v) { return std::atan2(v.y(), v.x()); }

double HalfTurn(double q) { return std::remainder(q, 2 * std::numbers::pi); }

Eigen::Matrix3d TurnZ(double q) {
  return Eigen::AngleAxisd(q, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

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

// The two angles x with a . (cos x, sin x) = c, one when they are the same.
struct TwoAngles {
  int count = 0;
  std::array<double, 2> q;
};

TwoAngles AnglesOf(const Plane& a, double c) {
  const double norm = a.norm();
  if (!(norm > 0) || !(std::abs(c) <= norm * (1 + kBeyondOne))) return {};
  const double phase = AngleOf(a), half = std::acos(std::clamp(c / norm, -1.0, 1.0));
  return {half > 0 ? 2 : 1, {phase + half, phase - half}};
}

// Joints 1 to 3 put the wrist centre into its place.
class Shoulder {
 public:
  Shoulder(const JointChain& chain, const SphericalWrist& wrist)
      : C1_(chain.constant[1]), C2_(chain.constant[2]), b_(wrist.centre_3) {
    small_ = kOnAxis * CharacteristicLength(chain);
    r_ = C1_.R.row(2).transpose();
    d_ = C1_.R.transpose() * C1_.p;
    const double squared = r_.head<2>().squaredNorm();
    parallel_ = squared < kParallel * kParallel;
    // The origin on axis 1 moved to the foot of the common normal: then r . d' = 0 in the plane.
    shift_ = parallel_ ? 0 : d_.head<2>().dot(r_.head<2>()) / squared;
    d_ -= shift_ * r_;
    meeting_ = d_.head<2>().norm() < kParallel * CharacteristicLength(chain);
  }

  // Axes 1 and 2 are not one line, joint 3 moves W and not only in a plane that joints 1 and 2
  // move it in already.
  bool CanPlace() const {
    const bool flat = parallel_ && C2_.R.col(2).head<2>().norm() < kParallel;
    return !(parallel_ && meeting_) && !flat && b_.head<2>().norm() > small_;
  }

  // @param w the wrist centre in the frame before joint 1.
  template <typename Use>
  void ForEach(const Eigen::Vector3d& w, const double* q_reference, Use use) const {
    const Trigonometric A = Constant(w.z() - C1_.p.z()) - r_.z() * Component(2);
    const double half = 0.5 * (w.squaredNorm() - C1_.p.squaredNorm());
    const Trigonometric B = Constant(half) - 0.5 * SquaredLength() -
                            shift_ * Constant(w.z() - C1_.p.z()) - d_.z() * Component(2);
    const Roots roots = RootsOf(EquationOf(A, B));
    for (int i = 0; i < roots.count; ++i) {
      const double q3 = roots.q[i];
      const Eigen::Vector3d g = C2_ * Eigen::Vector3d(TurnZ(q3) * b_);
      const TwoAngles h = DirectionsOf(A.At(q3), B.At(q3), g.head<2>().norm());
      for (int k = 0; k < h.count; ++k) {
        const bool free = g.head<2>().norm() < small_;
        const double q2 = free ? q_reference[1] : h.q[k] - AngleOf(g.head<2>());
        use(FirstJoint(w, g, q2, q_reference[0]), q2, q3);
      }
    }
  }

 private:
  static Trigonometric Constant(double value) { return {value, 0, 0, 0, 0}; }

  // v . Z_3(q3) b
  Trigonometric Along(const Eigen::Vector3d& v) const {
    return {v.z() * b_.z(), v.x() * b_.x() + v.y() * b_.y(), v.y() * b_.x() - v.x() * b_.y(), 0, 0};
  }

  Trigonometric Component(int i) const {
    return Constant(C2_.p(i)) + Along(C2_.R.row(i).transpose());
  }

  Trigonometric SquaredLength() const {
    return Constant(C2_.p.squaredNorm() + b_.squaredNorm()) +
           2.0 * Along(C2_.R.transpose() * C2_.p);
  }

  Trigonometric EquationOf(const Trigonometric& A, const Trigonometric& B) const {
    if (parallel_) return A;
    if (meeting_) return B;
    const Trigonometric x = Component(0), y = Component(1);
    return (1 / r_.head<2>().squaredNorm()) * (A * A) + (1 / d_.head<2>().squaredNorm()) * (B * B) -
           (x * x + y * y);
  }

  // Directions of h in its plane. @param size |h|.
  TwoAngles DirectionsOf(double A, double B, double size) const {
    const Plane r = r_.head<2>(), d = d_.head<2>();
    if (parallel_) return AnglesOf(size * d, B);
    if (meeting_) return AnglesOf(size * r, A);
    return {1, {AngleOf(A / r.squaredNorm() * r + B / d.squaredNorm() * d), 0}};
  }

  double FirstJoint(const Eigen::Vector3d& w, const Eigen::Vector3d& g, double q2,
                    double reference) const {
    const Eigen::Vector3d f = C1_ * Eigen::Vector3d(TurnZ(q2) * g);
    if (w.head<2>().norm() < small_) return reference;
    return AngleOf(w.head<2>()) - AngleOf(f.head<2>());
  }

  const Pose &C1_, &C2_;
  const Eigen::Vector3d b_;
  Eigen::Vector3d r_, d_;
  double shift_, small_;
  bool parallel_, meeting_;
};

// q4, q5, q6 with Z_4 A Z_5 B Z_6 = M.
template <typename Use>
void ForEachWrist(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B, const Eigen::Matrix3d& M,
                  const double* q_reference, Use use) {
  const Eigen::Vector3d a = A.row(2).transpose(), b = B.col(2);
  const Plane linear(a.x() * b.x() + a.y() * b.y(), a.y() * b.x() - a.x() * b.y());
  const TwoAngles q5 = AnglesOf(linear, M(2, 2) - a.z() * b.z());
  for (int k = 0; k < q5.count; ++k) {
    const Eigen::Matrix3d K = A * TurnZ(q5.q[k]) * B;
    const Plane axis = K.col(2).head<2>();
    const bool straight = axis.norm() < kOnAxis;
    const double q4 = straight ? q_reference[3] : AngleOf(M.col(2).head<2>()) - AngleOf(axis);
    const Eigen::Matrix3d last = K.transpose() * TurnZ(-q4) * M;
    use(q4, q5.q[k], std::atan2(last(1, 0) - last(0, 1), last(0, 0) + last(1, 1)));
  }
}

}  // namespace

SphericalWrist SphericalWristOf(const JointChain& chain) noexcept {
  SphericalWrist wrist;
  if (chain.joints != 6) return wrist;
  for (int i = 0; i < 6; ++i) {
    if (chain.prismatic[i]) return wrist;
  }
  const Meeting of_45 = MeetingOf(chain.constant[4]), of_56 = MeetingOf(chain.constant[5]);
  if (!of_45.meet || !of_56.meet || std::abs(of_45.second - of_56.first) > kMeeting) return wrist;
  wrist.centre_3 = chain.constant[3] * Eigen::Vector3d(0, 0, of_45.first);
  wrist.centre_F = Inverse(chain.constant[6]) * Eigen::Vector3d(0, 0, of_56.second);
  wrist.is_one = Shoulder(chain, wrist).CanPlace();
  return wrist;
}

WristBranches WristCandidates(const JointChain& chain, const SphericalWrist& wrist,
                              const Pose& X_BF, const double* q_reference) noexcept {
  WristBranches branches;
  const auto& C = chain.constant;
  const Eigen::Vector3d w = Inverse(C[0]) * Eigen::Vector3d(X_BF * wrist.centre_F);
  const Eigen::Matrix3d R_0F = C[0].R.transpose() * X_BF.R * C[6].R.transpose();
  Shoulder(chain, wrist).ForEach(w, q_reference, [&](double q1, double q2, double q3) {
    const Eigen::Matrix3d R_03 = TurnZ(q1) * C[1].R * TurnZ(q2) * C[2].R * TurnZ(q3) * C[3].R;
    ForEachWrist(C[4].R, C[5].R, R_03.transpose() * R_0F, q_reference,
                 [&](double q4, double q5, double q6) {
                   if (branches.count == kMaxWristBranches) return;
                   branches.q[branches.count++] = {HalfTurn(q1), HalfTurn(q2), HalfTurn(q3),
                                                   HalfTurn(q4), HalfTurn(q5), HalfTurn(q6)};
                 });
  });
  return branches;
}

}  // namespace truepose::compensation
