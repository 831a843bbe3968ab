#include "tests/core/testing/estimator_case.h"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <utility>

#include "tests/core/testing/robots.h"

namespace truepose::testing {
namespace {

template <typename T>
T Expect(absl::StatusOr<T> value) {
  if (value.ok()) return *std::move(value);
  std::cerr << value.status() << "\n";
  std::abort();
}

}  // namespace

EstimatorCase::EstimatorCase(Robot robot, std::vector<Reading> readings, std::optional<Pose> X_FT)
    : robot_(std::move(robot)),
      model_(std::make_unique<Model>(ModifiedIncremental(robot_, ModelExtent::kInternal))),
      problem_{model_.get(), std::move(readings), {""}, {""}} {
  StartOptions options;
  options.X_FT = X_FT;
  const Identification before =
      Expect(FitFrames(problem_, Expect(FindStart(problem_, options, {})), {}, {}));
  const Identification found =
      Expect(Identify(problem_, GenericIdentifiable(problem_, robot_), before, {}, {}));
  start_ = before.estimate;
  model_error_ = found.model_error;
  active_ = found.set.active;
}

SolveSummary EstimatorCase::SolveBy(const SolveOptions& options, Estimate* estimate) const {
  return SolveBy(options, active_, estimate);
}

SolveSummary EstimatorCase::SolveBy(const SolveOptions& options, const std::vector<int>& active,
                                    Estimate* estimate) const {
  *estimate = start_;
  return Solve(problem_, model_error_, active, options, {}, estimate);
}

SolveOptions OptionsFor(Estimator estimator) {
  SolveOptions options;
  options.estimator = estimator;
  return options;
}

std::vector<Reading> ReadingsOf(const Simulated& simulated, ObservationKind kind) {
  return simulated.Problem(kind, 0).readings;
}

EstimatorCase PoseMatchingCase(uint64_t seed) {
  constexpr double kResolution = 0.018 * kDeg;
  SimulateOptions options;
  options.poses = 81;
  options.seed = seed;
  options.length_error_sd_m = 1e-3;
  options.angle_error_sd_rad = 3e-3;
  options.position_noise_sd_m = 1.5e-5;
  options.rotation_noise_sd_rad = 8e-5;
  options.encoder_resolution = kResolution;
  const Simulated simulated(MeasuringArm(), AnyTarget(), options);
  std::vector<Reading> readings = ReadingsOf(simulated, ObservationKind::kPointAxis);
  for (Reading& reading : readings) {
    reading.position_sd_m.setConstant(options.position_noise_sd_m);
    reading.rotation_sd_rad = options.rotation_noise_sd_rad;
    // Rounding is uniform over the resolution.
    reading.joint_sd = Eigen::VectorXd::Constant(5, kResolution / std::sqrt(12.0));
  }
  return EstimatorCase(MeasuringArm(), std::move(readings));
}

}  // namespace truepose::testing
