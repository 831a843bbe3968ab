#include "compensation/trigonometric.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>

namespace truepose::compensation {
namespace {

using Complex = std::complex<double>;

constexpr double kVanishing = 1e-13;
constexpr double kMerged = 1e-2;

double SizeOf(const Trigonometric& f) {
  return std::max({std::abs(f.c0), std::abs(f.c1), std::abs(f.s1), std::abs(f.c2), std::abs(f.s2)});
}

// c0 + a cos(q - phase) = 0: two roots, one where they have merged, or none.
Roots FirstOrderRoots(const Trigonometric& f) {
  Roots roots;
  const double a = std::hypot(f.c1, f.s1), phase = std::atan2(f.s1, f.c1);
  const double ratio = -f.c0 / a;
  // cos x = 1 + t has complex roots with ln|z| = sqrt(2 t).
  if (!(std::abs(ratio) < 1 + kMerged * kMerged / 2)) return roots;
  const double half = std::acos(std::clamp(ratio, -1.0, 1.0));
  for (const double sign : {1.0, -1.0})
    roots.q[roots.count++] = std::remainder(phase + sign * half, 2 * EIGEN_PI);
  if (half == 0) roots.count = 1;
  return roots;
}

// z^2 f with z = e^iq is a polynomial of degree 4; its roots are the eigenvalues of the companion.
Roots SecondOrderRoots(const Trigonometric& f) {
  const Complex leading(f.c2 / 2, -f.s2 / 2), next(f.c1 / 2, -f.s1 / 2);
  const std::array<Complex, 4> lower = {std::conj(leading), std::conj(next), f.c0, next};
  Eigen::Matrix4cd companion = Eigen::Matrix4cd::Zero();
  for (int i = 0; i < 4; ++i) {
    companion(i, 3) = -lower[i] / leading;
    if (i > 0) companion(i, i - 1) = 1;
  }
  const Eigen::ComplexEigenSolver<Eigen::Matrix4cd> solver(companion, false);
  Roots roots;
  if (solver.info() != Eigen::Success) return roots;
  for (int i = 0; i < 4; ++i) {
    const Complex z = solver.eigenvalues()(i);
    if (std::abs(std::log(std::abs(z))) < kMerged) roots.q[roots.count++] = std::arg(z);
  }
  return roots;
}

}  // namespace

double Trigonometric::At(double q) const noexcept {
  return c0 + c1 * std::cos(q) + s1 * std::sin(q) + c2 * std::cos(2 * q) + s2 * std::sin(2 * q);
}

Trigonometric operator*(const Trigonometric& a, const Trigonometric& b) noexcept {
  Trigonometric f;
  f.c0 = a.c0 * b.c0 + 0.5 * (a.c1 * b.c1 + a.s1 * b.s1);
  f.c1 = a.c0 * b.c1 + a.c1 * b.c0;
  f.s1 = a.c0 * b.s1 + a.s1 * b.c0;
  f.c2 = 0.5 * (a.c1 * b.c1 - a.s1 * b.s1);
  f.s2 = 0.5 * (a.c1 * b.s1 + a.s1 * b.c1);
  return f;
}

Trigonometric operator+(const Trigonometric& a, const Trigonometric& b) noexcept {
  return {a.c0 + b.c0, a.c1 + b.c1, a.s1 + b.s1, a.c2 + b.c2, a.s2 + b.s2};
}

Trigonometric operator-(const Trigonometric& a, const Trigonometric& b) noexcept {
  return a + -1.0 * b;
}

Trigonometric operator*(double factor, const Trigonometric& a) noexcept {
  return {factor * a.c0, factor * a.c1, factor * a.s1, factor * a.c2, factor * a.s2};
}

Roots RootsOf(const Trigonometric& f) noexcept {
  const double size = SizeOf(f);
  if (!(size > 0) || !std::isfinite(size)) return {};
  if (std::hypot(f.c2, f.s2) > kVanishing * size) return SecondOrderRoots(f);
  if (std::hypot(f.c1, f.s1) > kVanishing * size) return FirstOrderRoots(f);
  return {};
}

}  // namespace truepose::compensation
