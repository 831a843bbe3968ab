// Multilinear interpolation as one writes it down: weights of all 2^n corners of all axes, in
// double.
#pragma once

#include <Eigen/Core>

#include "compensation/table.h"

namespace truepose::bench {

Eigen::Matrix<double, 6, 1> PlainLookUp(const compensation::TableContent& table, const double* q);

}  // namespace truepose::bench
