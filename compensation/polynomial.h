// Real roots of polynomials of at most fourth degree.
#pragma once

#include "compensation/trigonometric.h"

namespace truepose::compensation {

// f(x) = c0 + c1 x + c2 x^2 + c3 x^3 + c4 x^4.
struct Polynomial {
  double c0 = 0, c1 = 0, c2 = 0, c3 = 0, c4 = 0;

  double At(double x) const noexcept;
};

// Products of polynomials of at most second degree (c3 = c4 = 0) are of at most fourth.
Polynomial operator*(const Polynomial& a, const Polynomial& b) noexcept;
Polynomial operator+(const Polynomial& a, const Polynomial& b) noexcept;
Polynomial operator-(const Polynomial& a, const Polynomial& b) noexcept;
Polynomial operator*(double factor, const Polynomial& a) noexcept;

// All real roots, and the place of closest approach where two have just merged (imaginary parts
// below about 1e-2): what is a root and what is not is for the caller to test. For x of the order
// of one: roots beyond 1e4 count as infinite, leading terms below 1e-13 of the largest as none.
// None when the polynomial vanishes identically.
//
// Up to second degree in closed form. With x = tan(q / 2) a polynomial of degree four times
// cos^4(q / 2) is a second-order trigonometric one, in which a degree that is lower is a root
// at q = pi and nothing special.
Roots RootsOf(const Polynomial& f) noexcept;

}  // namespace truepose::compensation
