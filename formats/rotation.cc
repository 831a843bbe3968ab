#include "formats/rotation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/fault.h"
#include "formats/strings.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

// Four to nine digits are common in files; an error of 1e-3 is not rounding.
constexpr double kRounded = 1e-3;
// A unit vector of doubles that was just divided by its length is off by at most a few units in the
// last place.
constexpr double kLastBits = 2e-15;

QuaternionArray Multiply(const QuaternionArray& a, const QuaternionArray& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
          a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
          a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

bool IsOrder(std::string_view axes) {
  const auto is_axis = [](char c) { return c >= 'x' && c <= 'z'; };
  return axes.size() == 3 && std::all_of(axes.begin(), axes.end(), is_axis) && axes[0] != axes[1] &&
         axes[1] != axes[2];
}

absl::Status ConventionFault(std::string_view name) {
  return FaultStatus("euler", Quoted(name),
                     "three axes and -intrinsic or -extrinsic, such as xyz-intrinsic");
}

}  // namespace

absl::StatusOr<EulerConvention> ParseEulerConvention(std::string_view name) {
  std::string_view axes = name;
  const bool intrinsic = ConsumeSuffix(&axes, "-intrinsic");
  const bool extrinsic = !intrinsic && ConsumeSuffix(&axes, "-extrinsic");
  if ((!intrinsic && !extrinsic) || !IsOrder(axes)) return ConventionFault(name);
  const bool repeated = axes[0] == axes[2];
  EulerConvention convention;
  for (int i = 0; i < 3; ++i) {
    convention.axes[i] = axes[i] - 'x';
    convention.angles[i] = repeated ? i : convention.axes[i];
  }
  if (extrinsic) {
    std::swap(convention.axes[0], convention.axes[2]);
    std::swap(convention.angles[0], convention.angles[2]);
  }
  return convention;
}

QuaternionArray FromEuler(const EulerConvention& convention, const std::array<double, 3>& angles) {
  QuaternionArray product = {0, 0, 0, 1};
  for (int i = 0; i < 3; ++i) {
    const double half = angles[convention.angles[i]] / 2;
    QuaternionArray factor = {0, 0, 0, std::cos(half)};
    factor[convention.axes[i]] = std::sin(half);
    product = Multiply(product, factor);
  }
  NormaliseRounded(product);
  return product;
}

double AngleBetween(const QuaternionArray& a, const QuaternionArray& b) {
  const QuaternionArray turn = Multiply({-a[0], -a[1], -a[2], a[3]}, b);
  return 2 * std::atan2(std::hypot(turn[0], turn[1], turn[2]), std::abs(turn[3]));
}

double Length(std::span<const double> v) {
  double square = 0;
  for (const double value : v) square += value * value;
  return std::sqrt(square);
}

bool NormaliseRounded(std::span<double> v) {
  const double length = Length(v);
  if (!(std::abs(length - 1) <= kRounded)) return false;
  if (std::abs(length * length - 1) <= kLastBits) return true;
  for (double& value : v) value /= length;
  return true;
}

}  // namespace truepose::formats
