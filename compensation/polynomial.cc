#include "compensation/polynomial.h"

#include <algorithm>
#include <cmath>

namespace truepose::compensation {
namespace {

constexpr double kVanishing = 1e-13;
constexpr double kMerged = 1e-2;
constexpr double kInfinite = 1e4;

double SizeOf(const Polynomial& f) {
  return std::max({std::abs(f.c0), std::abs(f.c1), std::abs(f.c2), std::abs(f.c3), std::abs(f.c4)});
}

void Append(double x, Roots* roots) {
  if (std::abs(x) < kInfinite) roots->q[roots->count++] = x;
}

// The larger one first: it has no cancellation, and the product of both is c0 / c2.
Roots SecondDegreeRoots(const Polynomial& f) {
  Roots roots;
  const double middle = -0.5 * f.c1 / f.c2;
  const double squared = middle * middle - f.c0 / f.c2;
  if (squared <= 0) {
    if (squared > -kMerged * kMerged) Append(middle, &roots);
    return roots;
  }
  const double larger = middle + std::copysign(std::sqrt(squared), middle);
  Append(larger, &roots);
  Append(f.c0 / (f.c2 * larger), &roots);
  return roots;
}

// cos^4(q / 2) f(tan(q / 2)).
Trigonometric HalfTangent(const Polynomial& f) {
  const Trigonometric cosine = {0.5, 0.5}, sine = {0.5, -0.5};  // squares of those of q / 2
  const Trigonometric product = {0, 0, 0.5};
  return f.c0 * (cosine * cosine) + f.c1 * (cosine * product) + f.c2 * (cosine * sine) +
         f.c3 * (product * sine) + f.c4 * (sine * sine);
}

Roots FourthDegreeRoots(const Polynomial& f) {
  const Roots halves = RootsOf(HalfTangent(f));
  Roots roots;
  for (int i = 0; i < halves.count; ++i) Append(std::tan(halves.q[i] / 2), &roots);
  return roots;
}

}  // namespace

double Polynomial::At(double x) const noexcept {
  return c0 + x * (c1 + x * (c2 + x * (c3 + x * c4)));
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) noexcept {
  return {a.c0 * b.c0, a.c0 * b.c1 + a.c1 * b.c0, a.c0 * b.c2 + a.c1 * b.c1 + a.c2 * b.c0,
          a.c1 * b.c2 + a.c2 * b.c1, a.c2 * b.c2};
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) noexcept {
  return {a.c0 + b.c0, a.c1 + b.c1, a.c2 + b.c2, a.c3 + b.c3, a.c4 + b.c4};
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) noexcept { return a + -1.0 * b; }

Polynomial operator*(double factor, const Polynomial& a) noexcept {
  return {factor * a.c0, factor * a.c1, factor * a.c2, factor * a.c3, factor * a.c4};
}

Roots RootsOf(const Polynomial& f) noexcept {
  const double size = SizeOf(f), least = kVanishing * size;
  if (!(size > 0) || !std::isfinite(size)) return {};
  if (std::abs(f.c3) > least || std::abs(f.c4) > least) return FourthDegreeRoots(f);
  if (std::abs(f.c2) > least) return SecondDegreeRoots(f);
  Roots roots;
  if (std::abs(f.c1) > least) Append(-f.c0 / f.c1, &roots);
  return roots;
}

}  // namespace truepose::compensation
