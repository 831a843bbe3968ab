#include "core/assessment/suspects.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "absl/strings/str_format.h"
#include "core/base/chi_square.h"
#include "core/identification/prediction.h"

namespace truepose {
namespace {

constexpr double kOrdinary = 1 - 1e-6;

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// Sizes of the two parts of every reading's residual; rotation -1 where there is none.
struct Parts {
  std::vector<double> position_m, rotation_rad;
};

Parts PartsOf(const Problem& problem, const Estimate& estimate) {
  Parts parts;
  for (const Reading& reading : problem.readings) {
    const Residual r = ResidualAt(problem, reading, estimate);
    const Eigen::Index rotations = RotationRowsOf(reading);
    parts.position_m.push_back(r.head(r.size() - rotations).norm());
    parts.rotation_rad.push_back(rotations > 0 ? r.tail(rotations).norm() : -1);
  }
  return parts;
}

double UsualRotation(const Parts& parts) {
  std::vector<double> measured;
  std::copy_if(parts.rotation_rad.begin(), parts.rotation_rad.end(), std::back_inserter(measured),
               [](double angle) { return angle >= 0; });
  return Median(measured);
}

std::string Reason(double position_m, double usual_m, double rotation_rad, double usual_rad) {
  const double of_position = position_m / std::max(usual_m, 1e-12);
  const double of_rotation = rotation_rad < 0 ? 0 : rotation_rad / std::max(usual_rad, 1e-12);
  if (of_rotation > of_position) {
    return absl::StrFormat("orientation off by %.3f deg, %.1f times the usual %.3f deg",
                           rotation_rad * 180 / std::numbers::pi, of_rotation,
                           usual_rad * 180 / std::numbers::pi);
  }
  return absl::StrFormat("position off by %.3f mm, %.1f times the usual %.3f mm", 1e3 * position_m,
                         of_position, 1e3 * usual_m);
}

// Sizes relative to the median that normal residuals with so many rows would have.
double ScaleOf(const Problem& problem, const std::vector<double>& sizes) {
  std::vector<double> relative;
  for (size_t i = 0; i < sizes.size(); ++i)
    relative.push_back(sizes[i] / std::sqrt(ChiSquareQuantile(0.5, RowsOf(problem.readings[i]))));
  return std::max(Median(relative), 1e-12);
}

}  // namespace

std::vector<Suspect> Suspects(const Problem& problem, const Estimate& estimate,
                              const ModelError& model_error, const std::vector<double>& weights) {
  std::vector<double> sizes;
  for (const Reading& reading : problem.readings)
    sizes.push_back(ResidualSize(problem, reading, estimate, model_error));
  const double scale = ScaleOf(problem, sizes);
  const Parts parts = PartsOf(problem, estimate);
  const double usual_m = Median(parts.position_m), usual_rad = UsualRotation(parts);
  std::vector<Suspect> suspects;
  for (size_t i = 0; i < sizes.size(); ++i) {
    const double d = sizes[i] / scale;
    if (d * d < ChiSquareQuantile(kOrdinary, RowsOf(problem.readings[i]))) continue;
    suspects.push_back({static_cast<int>(i), d, weights.empty() ? 1 : weights[i],
                        Reason(parts.position_m[i], usual_m, parts.rotation_rad[i], usual_rad)});
  }
  std::stable_sort(suspects.begin(), suspects.end(),
                   [](const Suspect& a, const Suspect& b) { return a.size > b.size; });
  return suspects;
}

}  // namespace truepose
