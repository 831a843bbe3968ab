#include "core/assessment/flange_rotation.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "absl/strings/str_format.h"

namespace truepose {
namespace {

constexpr double kMost_rad = 0.5 * std::numbers::pi / 180;

// Places of the internal parameters in the covariance, and which parameters of the model they are.
struct Internal {
  std::vector<int> places, parameters;
};

Internal InternalOf(const Problem& problem, const std::vector<int>& active) {
  Internal internal;
  for (size_t i = 0; i < active.size(); ++i) {
    if (active[i] < problem.FirstInternal()) continue;
    internal.places.push_back(static_cast<int>(i));
    internal.parameters.push_back(active[i] - problem.FirstInternal());
  }
  return internal;
}

}  // namespace

double FlangeRotationSd(const Problem& problem, const Identification& identification) {
  const Internal internal = InternalOf(problem, identification.set.active);
  const bool known = identification.covariance.rows() ==
                     static_cast<Eigen::Index>(identification.set.active.size());
  if (!known || internal.places.empty() || problem.readings.empty()) return 0;
  const Eigen::MatrixXd C = identification.covariance(internal.places, internal.places);
  ModelSweep sweep;
  double sum = 0;
  for (const Reading& reading : problem.readings) {
    RunSweep(*problem.model, reading.q.data(), identification.estimate.lambda.data(),
             reading.conditions, &sweep);
    const Eigen::MatrixXd J = sweep.J_parameters.bottomRows(3)(Eigen::all, internal.parameters);
    sum += (J * C * J.transpose()).trace();
  }
  return std::sqrt(sum / static_cast<double>(problem.readings.size()));
}

void JudgeFlangeRotation(double rotation_sd_rad, Verdict* verdict) {
  if (!(rotation_sd_rad > kMost_rad)) return;
  if (verdict->decision == Decision::kApply) verdict->decision = Decision::kApplyWithinVolume;
  verdict->reasons.push_back(absl::StrFormat(
      "the orientation of the flange is known to %.1f deg only: right at the point that was "
      "measured, not for other tools; measure orientations or a second point, or add --prior "
      "tolerance",
      rotation_sd_rad * 180 / std::numbers::pi));
}

}  // namespace truepose
