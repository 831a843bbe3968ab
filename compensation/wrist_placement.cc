#include "compensation/wrist_placement.h"

#include <Eigen/LU>
#include <cmath>

#include "compensation/polynomial.h"
#include "compensation/singularity.h"
#include "compensation/trigonometric.h"

namespace truepose::compensation {
namespace {

constexpr double kParallel = 1e-5;  // sine of the angle between axes that count as parallel
constexpr double kOnAxis = 1e-9;    // of the unit of length: nothing turns the point
// The same at a q3 where the point passes axis 2: a double root, right to the root of the last bit.
constexpr double kPassesAxis = 1e-7;
// Where |h| and |g_xy| differ by this the two q3 have not merged but are far from real: their
// imaginary part is small only because m_2 is.
constexpr double kNoRoot = 0.05;
constexpr double kPlaces = 1e-4;  // volume of motions that are independent
// Joints 2 and 3 at which no geometry of a data sheet is singular; rad, characteristic lengths.
constexpr double kSomewhere[] = {0.31, 1.83, -2.21};

using Plane = Eigen::Vector2d;

double AngleOf(const Plane& v) { return std::atan2(v.y(), v.x()); }

// s . y + k |y|^2 / 2 = c, equation (1).
struct Invariant {
  Eigen::Vector3d s;
  double k, c;
};

struct Invariants {
  Invariant first, second;
};

Invariants OfTurn(const Pose& C, const Eigen::Vector3d& w) {
  return {{C.R.row(2).transpose(), 0, w.z() - C.p.z()},
          {C.R.transpose() * C.p, 1, 0.5 * (w.squaredNorm() - C.p.squaredNorm())}};
}

Invariants OfSlide(const Pose& C, const Eigen::Vector3d& w) {
  const double angle = AngleOf(C.R.col(2).head<2>());  // any when the axes are parallel
  const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0);
  const Eigen::Vector3d across(-along.y(), along.x(), 0);
  return {{C.R.transpose() * along, 0, along.dot(w - C.p)},
          {C.R.transpose() * across, 0, across.dot(w - C.p)}};
}

Invariant Sum(double a, const Invariant& x, double b, const Invariant& y) {
  return {a * x.s + b * y.s, a * x.k + b * y.k, a * x.c + b * y.c};
}

// The rotation of the two that makes their s_xy orthogonal (Jacobi's), the longer one first.
Invariants Orthogonal(const Invariants& pair) {
  const Plane a = pair.first.s.head<2>(), b = pair.second.s.head<2>();
  const double angle = 0.5 * std::atan2(2 * a.dot(b), a.squaredNorm() - b.squaredNorm());
  const double cosine = std::cos(angle), sine = std::sin(angle);
  return {Sum(cosine, pair.first, sine, pair.second), Sum(-sine, pair.first, cosine, pair.second)};
}

// a . Z_3(q3) b and |Z_3(q3) b|^2 in what the joint's type makes of q3.
template <typename Ring>
Ring Along(const Eigen::Vector3d& a, const Eigen::Vector3d& b);
template <typename Ring>
Ring SquaredLength(const Eigen::Vector3d& b);

template <>
Trigonometric Along<Trigonometric>(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a.z() * b.z(), a.x() * b.x() + a.y() * b.y(), a.y() * b.x() - a.x() * b.y()};
}

template <>
Trigonometric SquaredLength<Trigonometric>(const Eigen::Vector3d& b) {
  return {b.squaredNorm()};
}

template <>
Polynomial Along<Polynomial>(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a.dot(b), a.z()};
}

template <>
Polynomial SquaredLength<Polynomial>(const Eigen::Vector3d& b) {
  return {b.squaredNorm(), 2 * b.z(), 1};
}

// g(q3) and |g|^2.
template <typename Ring>
struct MovedPoint {
  Ring x, y, z, squared;

  MovedPoint(const Pose& C, const Eigen::Vector3d& b)
      : x(Coordinate(C, 0, b)),
        y(Coordinate(C, 1, b)),
        z(Coordinate(C, 2, b)),
        squared(Ring{C.p.squaredNorm()} + SquaredLength<Ring>(b) +
                2.0 * Along<Ring>(C.R.transpose() * C.p, b)) {}

  Ring Dot(const Eigen::Vector3d& s) const { return s.x() * x + s.y() * y + s.z() * z; }
  Plane AcrossAt(double q3) const { return {x.At(q3), y.At(q3)}; }

 private:
  static Ring Coordinate(const Pose& C, int i, const Eigen::Vector3d& b) {
    return Ring{C.p(i)} + Along<Ring>(C.R.row(i).transpose(), b);
  }
};

void Append(double q2, double q3, Placements* places) {
  if (places->count < kMaxPlacements) places->q[places->count++] = {0, q2, q3};
}

// E(q3) of an equation.
template <typename Ring>
Ring RestOf(const Invariant& equation, const MovedPoint<Ring>& g) {
  return Ring{equation.c} - equation.s.z() * g.z - 0.5 * equation.k * g.squared;
}

// The angles q2 by which g is turned when s . (g turned) = E.
Roots TurnsOf(const Plane& s, const Plane& g, double E) {
  return RootsOf(Trigonometric{-E, s.dot(g), s.y() * g.x() - s.x() * g.y()});
}

// Joint 2 revolute: equations (2) and (3).
template <typename Ring>
void TurnSecond(const Invariants& of_joint_1, const MovedPoint<Ring>& g, double q2_reference,
                Placements* places) {
  const auto [first, second] = Orthogonal(of_joint_1);
  const Plane s1 = first.s.head<2>(), s2 = second.s.head<2>();
  const double m1 = s1.squaredNorm(), m2 = s2.squaredNorm();
  const bool in_one_plane = m2 < kParallel * kParallel;
  const Ring E1 = RestOf(first, g), E2 = RestOf(second, g);
  const Roots q3 = RootsOf(
      in_one_plane ? E2 : m2 * (E1 * E1) + m1 * (E2 * E2) - m1 * m2 * (g.x * g.x + g.y * g.y));
  for (int i = 0; i < q3.count; ++i) {
    const Plane across = g.AcrossAt(q3.q[i]);
    const double e1 = E1.At(q3.q[i]), e2 = E2.At(q3.q[i]);
    if (across.norm() < kPassesAxis) {
      Append(q2_reference, q3.q[i], places);
    } else if (in_one_plane) {
      const Roots q2 = TurnsOf(s1, across, e1);
      for (int k = 0; k < q2.count; ++k) Append(q2.q[k], q3.q[i], places);
    } else {
      const Plane h = e1 / m1 * s1 + e2 / m2 * s2;
      if (std::abs(h.norm() - across.norm()) > kNoRoot) continue;
      Append(AngleOf(h) - AngleOf(across), q3.q[i], places);
    }
  }
}

// Equation (4) as a polynomial of q2 where g stands at one q3.
template <typename Ring>
Polynomial SlideEquation(const Invariant& second, const MovedPoint<Ring>& g, double q3) {
  const double k = second.k;
  return {g.Dot(second.s).At(q3) + 0.5 * k * g.squared.At(q3) - second.c,
          second.s.z() + k * g.z.At(q3), 0.5 * k};
}

// Joint 2 prismatic: equations (4) and (5).
template <typename Ring>
void SlideSecond(const Invariants& of_joint_1, const MovedPoint<Ring>& g, Placements* places) {
  const auto& [first, second] = of_joint_1;
  const Ring left = Ring{first.c} - g.Dot(first.s);
  if (std::abs(first.s.z()) < kParallel) {
    const Roots q3 = RootsOf(left);
    for (int i = 0; i < q3.count; ++i) {
      const Roots q2 = RootsOf(SlideEquation(second, g, q3.q[i]));
      for (int k = 0; k < q2.count; ++k) Append(q2.q[k], q3.q[i], places);
    }
    return;
  }
  const Ring q2 = (1 / first.s.z()) * left;
  const Ring half = 0.5 * g.squared + g.z * q2 + 0.5 * (q2 * q2);
  const Roots q3 = RootsOf(g.Dot(second.s) + second.s.z() * q2 + second.k * half - Ring{second.c});
  for (int i = 0; i < q3.count; ++i) Append(q2.At(q3.q[i]), q3.q[i], places);
}

template <typename Ring>
Placements SecondAndThird(bool slides, const Invariants& of_joint_1, const Pose& C2,
                          const Eigen::Vector3d& b, double q2_reference) {
  Placements places;
  const MovedPoint<Ring> g(C2, b);
  if (slides)
    SlideSecond(of_joint_1, g, &places);
  else
    TurnSecond(of_joint_1, g, q2_reference, &places);
  return places;
}

// The chain up to joint 3 with the point for a flange.
JointChain FirstThree(const JointChain& chain, const Eigen::Vector3d& b) {
  JointChain three;
  three.joints = 3;
  for (int i = 0; i < 3; ++i) {
    three.prismatic[i] = chain.prismatic[i];
    three.constant[i] = chain.constant[i];
  }
  three.constant[0] = {};
  three.constant[3].p = b;
  return three;
}

double FirstJoint(const JointChain& three, const Eigen::Vector3d& w, double q2, double q3,
                  double near_axis, double reference) {
  const double q[] = {0, q2, q3};
  const Eigen::Vector3d f = Forward(three, q).p;
  if (three.prismatic[0]) return w.z() - f.z();
  if (w.head<2>().norm() < near_axis) return reference;
  return AngleOf(w.head<2>()) - AngleOf(f.head<2>());
}

// Of the motions of the point at q1 = 0, lengths over `length_m`.
double VolumeAt(const JointChain& three, double q2, double q3, double length_m) {
  const double q[] = {0, three.prismatic[1] ? q2 * length_m : q2,
                      three.prismatic[2] ? q3 * length_m : q3};
  Motions motions;
  SetMotions(three, q, &motions);
  Sweep sweep;
  RunSweep(three, motions, &sweep);
  Eigen::Matrix3d J;
  for (int i = 0; i < 3; ++i)
    J.col(i) = ColumnOf(three, sweep, i).head<3>() / (three.prismatic[i] ? 1 : length_m);
  return std::abs(J.determinant());
}

}  // namespace

bool CanPlace(const JointChain& chain, const Eigen::Vector3d& b) noexcept {
  const JointChain three = FirstThree(chain, b);
  const double length_m = CharacteristicLength(chain);
  for (const double q2 : kSomewhere) {
    for (const double q3 : kSomewhere) {
      if (VolumeAt(three, q2, q3, length_m) > kPlaces) return true;
    }
  }
  return false;
}

Placements PlacementsOf(const JointChain& chain, const Eigen::Vector3d& b, const Eigen::Vector3d& w,
                        const double* q_reference) noexcept {
  const double unit = CharacteristicLength(chain) + w.norm();
  const Pose C1 = {chain.constant[1].R, chain.constant[1].p / unit};
  const Pose C2 = {chain.constant[2].R, chain.constant[2].p / unit};
  const Invariants of_joint_1 = chain.prismatic[0] ? OfSlide(C1, w / unit) : OfTurn(C1, w / unit);
  const auto solve =
      chain.prismatic[2] ? SecondAndThird<Polynomial> : SecondAndThird<Trigonometric>;
  Placements places = solve(chain.prismatic[1], of_joint_1, C2, b / unit, q_reference[1]);
  const JointChain three = FirstThree(chain, b);
  for (int i = 0; i < places.count; ++i) {
    auto& [q1, q2, q3] = places.q[i];
    if (chain.prismatic[1]) q2 *= unit;
    if (chain.prismatic[2]) q3 *= unit;
    q1 = FirstJoint(three, w, q2, q3, kOnAxis * unit, q_reference[0]);
  }
  return places;
}

}  // namespace truepose::compensation
