// Orientations as files give them: quaternions, and Euler angles of a named convention.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "absl/status/statusor.h"

namespace truepose::formats {

// x, y, z, w of a unit quaternion.
using QuaternionArray = std::array<double, 4>;

// A convention is three axes and `-intrinsic` or `-extrinsic`, in lower case: the six orders of
// three different axes
// (`xyz`, `zyx`, ...), where column r<axis> is the angle about that axis, and the six orders whose
// first and last axis are the same (`zyz`, `zxz`, ...), where rx, ry, rz are the first, second and
// third angle. Intrinsic `abc`: R = R(a) R(b) R(c), each about the axes as turned so far. Extrinsic
// `abc`: R = R(c) R(b) R(a).
struct EulerConvention {
  std::array<int, 3> axes;    // 0, 1, 2 for x, y, z, in the order of the product R
  std::array<int, 3> angles;  // which of the angles rx, ry, rz each factor takes
};

// @returns kInvalidArgument with one fault of the field `euler` for any other text.
absl::StatusOr<EulerConvention> ParseEulerConvention(std::string_view name);

// @param angles rx, ry, rz in rad.
QuaternionArray FromEuler(const EulerConvention& convention, const std::array<double, 3>& angles);

// The angle in rad between two orientations; q and -q are the same one.
double AngleBetween(const QuaternionArray& a, const QuaternionArray& b);

// Divides by the length; what is of length 1 to the last bits stays untouched, so that writing and
// reading again changes nothing.
// @returns false, and leaves `v` as it is, when the length is off 1 by more than 1e-3: then it's no
// rounded unit
//   vector but a mistake.
bool NormaliseRounded(std::span<double> v);

// Euclidean length.
double Length(std::span<const double> v);

}  // namespace truepose::formats
