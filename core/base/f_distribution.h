// Fisher's F distribution of k1 and k2 degrees of freedom.
#pragma once

namespace truepose {

// P(F > x). @param k1, k2 > 0. @returns 1 for x <= 0. To 1e-10 absolute.
double FSurvival(double x, double k1, double k2);

}  // namespace truepose
