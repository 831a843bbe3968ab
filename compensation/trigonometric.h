// Roots of trigonometric polynomials of first and second order.
#pragma once

#include <array>

namespace truepose::compensation {

// f(q) = c0 + c1 cos q + s1 sin q + c2 cos 2q + s2 sin 2q.
struct Trigonometric {
  double c0 = 0, c1 = 0, s1 = 0, c2 = 0, s2 = 0;

  double At(double q) const noexcept;
};

// Products and sums of first-order ones (c2 = s2 = 0) are second-order ones.
Trigonometric operator*(const Trigonometric& a, const Trigonometric& b) noexcept;
Trigonometric operator+(const Trigonometric& a, const Trigonometric& b) noexcept;
Trigonometric operator-(const Trigonometric& a, const Trigonometric& b) noexcept;
Trigonometric operator*(double factor, const Trigonometric& a) noexcept;

struct Roots {
  int count = 0;
  std::array<double, 4> q{};  // rad, within half a turn of zero
};

// All real roots, and the place of closest approach where two have just merged (complex roots with
// |ln|z|| < 1e-2 for z = e^iq): what is a root and what is not is for the caller to test.
// None when the polynomial vanishes identically. Leading terms below 1e-13 of the largest are none.
Roots RootsOf(const Trigonometric& f) noexcept;

}  // namespace truepose::compensation
