// A problem at the point where estimators begin.
#pragma once

#include <memory>
#include <optional>

#include "core/identification/identify.h"
#include "tests/core/testing/simulated.h"

namespace truepose::testing {

// Nominal parameters, frames fitted to them; active candidates and model error as an identification
// by Levenberg-Marquardt found them, so that every estimator gets one and the same weighted
// objective. One placement, one target.
class EstimatorCase {
 public:
  EstimatorCase(Robot robot, std::vector<Reading> readings, std::optional<Pose> X_FT = {});

  // From the start, with all active candidates or with those given.
  SolveSummary SolveBy(const SolveOptions& options, Estimate* estimate) const;
  SolveSummary SolveBy(const SolveOptions& options, const std::vector<int>& active,
                       Estimate* estimate) const;

  const Problem& problem() const { return problem_; }
  const Estimate& start() const { return start_; }
  const ModelError& model_error() const { return model_error_; }
  const std::vector<int>& active() const { return active_; }

 private:
  Robot robot_;
  std::unique_ptr<Model> model_;  // what the problem points to
  Problem problem_;
  Estimate start_;
  ModelError model_error_;
  std::vector<int> active_;
};

// Readings of a simulated robot, all of them.
std::vector<Reading> ReadingsOf(const Simulated& simulated, ObservationKind kind);

inline constexpr Estimator kEstimators[] = {Estimator::kLevenbergMarquardt,
                                            Estimator::kLinearIteration, Estimator::kKalman,
                                            Estimator::kSimplex};

SolveOptions OptionsFor(Estimator estimator);

// The chapter's measuring robot put into 81 places of a fixture: the place is known but for the
// hand (0.015 mm, 0.08 mrad), joints are read to 0.018 deg; both are stated.
EstimatorCase PoseMatchingCase(uint64_t seed);

}  // namespace truepose::testing
