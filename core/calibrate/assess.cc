#include "core/calibrate/assess.h"

#include <algorithm>
#include <cmath>

#include "core/assessment/flange_rotation.h"
#include "core/base/random.h"
#include "core/base/status_macros.h"

namespace truepose {
namespace {

Problem Chosen(const Problem& whole, const std::vector<bool>& chosen) {
  Problem problem = whole;
  problem.readings.clear();
  for (size_t i = 0; i < whole.readings.size(); ++i) {
    if (chosen[i]) problem.readings.push_back(whole.readings[i]);
  }
  return problem;
}

SetResult SetOf(const Problem& whole, const std::vector<bool>& chosen, const Estimate& before,
                const Estimate& after) {
  const Problem problem = Chosen(whole, chosen);
  return {PoseErrors(problem, before), PoseErrors(problem, after)};
}

// The chosen readings that stand in frames of the calibration part, numbered as those.
Problem InFramesOf(const Part& part, const CalibrationProblem& whole,
                   const std::vector<bool>& chosen) {
  Problem problem = part.problem;
  problem.readings.clear();
  const auto place = [](int index, const std::vector<int>& known) {
    return static_cast<int>(std::find(known.begin(), known.end(), index) - known.begin());
  };
  for (size_t i = 0; i < whole.readings.size(); ++i) {
    Reading reading = whole.readings[i];
    reading.placement = place(reading.placement, part.placements);
    reading.target = place(reading.target, part.targets);
    if (reading.offset >= 0) reading.offset = place(reading.offset, part.offsets);
    const bool known = reading.placement < static_cast<int>(part.placements.size()) &&
                       reading.target < static_cast<int>(part.targets.size()) &&
                       reading.offset < static_cast<int>(part.offsets.size());
    if (chosen[i] && known) problem.readings.push_back(std::move(reading));
  }
  return problem;
}

// Weights of all readings, from those of the calibration readings; 1 for control.
std::vector<double> WeightsOfWhole(const CalibrationProblem& whole,
                                   const Identification& identification) {
  std::vector<double> weights;
  size_t next = 0;
  for (const bool calibrates : whole.calibrates)
    weights.push_back(calibrates ? identification.weights[next++] : 1);
  return weights;
}

constexpr int kReadingsToLookAt = 200;

// At most so many of the calibration readings, with the first one's frames: where it was measured.
Problem Measured(const Problem& part) {
  Problem problem = part;
  problem.readings.clear();
  const size_t count = std::min<size_t>(part.readings.size(), kReadingsToLookAt);
  for (size_t i = 0; i < count; ++i) {
    problem.readings.push_back(part.readings[i * part.readings.size() / count]);
    problem.readings.back().placement = part.readings[0].placement;
    problem.readings.back().target = part.readings[0].target;
    problem.readings.back().offset = -1;
  }
  return problem;
}

// The same many within +-1.5 rad and +-0.3 m of the middle of the joints' limits.
Problem Elsewhere(const Problem& part, const Robot& robot) {
  Problem problem = Measured(part);
  Random random(7);
  for (Reading& reading : problem.readings) {
    Eigen::VectorXd q = robot.MiddleOfLimits();
    for (int j = 0; j < robot.joint_count(); ++j) {
      const Joint& joint = robot.joints()[j];
      const double reach = joint.type == JointType::kRevolute ? 1.5 : 0.3;
      q(j) +=
          random.Uniform(-std::min(reach, q(j) - joint.lower), std::min(reach, joint.upper - q(j)));
    }
    reading.q = robot.joint_map().ToChain(q);
  }
  return problem;
}

Verdict JudgeResult(const CalibrationProblem& problem, const Part& part,
                    const CalibrationResult& result) {
  Verdict verdict = Judge(result.identification, result.model.parameters, result.control.before,
                          result.control.after);
  JudgeVolume(ParameterUncertainty(Measured(part.problem), result.identification),
              ParameterUncertainty(Elsewhere(part.problem, *problem.robot), result.identification),
              UnexplainedOf(result.identification).position_sd_m * std::sqrt(3.0), &verdict);
  JudgeFlangeRotation(FlangeRotationSd(Measured(part.problem), result.identification), &verdict);
  JudgeSelection(result.selection, &verdict);
  if (result.change) {
    JudgeHeldFit(result.held_fit->chi_square, result.held_fit->degrees_of_freedom,
                 result.held_fit->p_value, &verdict);
    if (!result.change->names.empty())
      JudgeChange(result.change->p_value, result.change->real, &verdict);
  }
  return verdict;
}

}  // namespace

absl::Status Assess(const CalibrationProblem& problem, const Part& part, const Hooks& hooks,
                    CalibrationResult* result) {
  TRUEPOSE_ASSIGN_OR_RETURN(WholeFrames before,
                            FramesOfWhole(problem, result->model, part, result->before, hooks));
  TRUEPOSE_ASSIGN_OR_RETURN(WholeFrames after, FramesOfWhole(problem, result->model, part,
                                                             result->identification, hooks));
  result->before_frames = std::move(before.estimate);
  result->after_frames = std::move(after.estimate);
  result->base_fitted_on = std::move(after.base_fitted_on);
  result->tool_fitted_on = std::move(after.tool_fitted_on);
  std::vector<bool> controls = problem.calibrates;
  controls.flip();
  const std::vector<bool> all(problem.calibrates.size(), true);
  const Estimate &b = result->before_frames, &a = result->after_frames;
  const Problem whole = WholeProblem(problem, result->model);
  result->calibration = SetOf(whole, problem.calibrates, b, a);
  result->control = SetOf(whole, controls, b, a);
  result->complete = SetOf(whole, all, b, a);
  result->suspects = Suspects(whole, a, result->identification.model_error,
                              WeightsOfWhole(problem, result->identification));
  result->correlations = Correlations(result->identification);
  const Problem control = InFramesOf(part, problem, controls);
  if (result->identification.summary.termination == Termination::kConverged)
    result->predicted = Predicted(control, part.problem, result->identification);
  result->control_places = PlaceErrorsOf(Chosen(whole, controls), a);
  result->verdict = JudgeResult(problem, part, *result);
  return absl::OkStatus();
}

}  // namespace truepose
