#include "core/conversion/convert_calibration.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/random.h"
#include "core/base/status_macros.h"
#include "core/conversion/draw_joints.h"
#include "core/conversion/singular_link.h"
#include "core/identification/identifiability.h"
#include "core/identification/prediction.h"
#include "core/identification/solve.h"

namespace truepose {
namespace {

// Six rows each: more than three times as many as any arm has parameters, and few enough for QR.
constexpr int kSolvedPoses = 60;
constexpr int kCheckedPoses = 200;

// A calibration is stored to the micrometre; a thousandth of that is the same prediction.
constexpr double kSamePosition = 1e-9, kSameRotation = 1e-9;

// Regular forms magnify errors by their lengths at most, some ten times (axis_lines.h).
constexpr double kRunaway = 100;
constexpr double kSmallestError = 1e-6;  // m, rad: below it a ratio means nothing

bool IsEffect(const Parameter& parameter) { return parameter.role == ParameterRole::kEffect; }

void CheckValues(const Model& from, const Eigen::VectorXd& lambda, const Model& to,
                 FaultList* faults) {
  for (int i = 0; i < from.parameters.size(); ++i) {
    const Parameter& parameter = from.parameters[i];
    const std::string field = absl::StrCat("internal_parameters[", parameter.name, "]");
    if (!std::isfinite(lambda(i))) faults->Add(field, absl::StrCat(lambda(i)), "a finite number");
    if (IsEffect(parameter) && lambda(i) != 0 && !to.parameters.Find(parameter.name))
      faults->Add(field, absl::StrCat(lambda(i)),
                  absl::StrCat("an effect that ", to.kind, " has, too"));
  }
}

absl::Status CheckInput(const Robot& robot, const Model& from, const Eigen::VectorXd& lambda,
                        const Model& to) {
  FaultList faults;
  for (const Model* model : {&from, &to}) {
    if (JointCount(model->chain) != robot.joint_count())
      faults.Add("model", absl::StrCat(model->kind, " of ", JointCount(model->chain), " joints"),
                 absl::StrCat(robot.joint_count(), " joints"));
  }
  if (lambda.size() != from.parameters.size()) {
    faults.Add("internal_parameters", absl::StrCat(lambda.size(), " values"),
               absl::StrCat(from.parameters.size(), " of ", from.kind));
  } else {
    CheckValues(from, lambda, to, &faults);
  }
  return faults.ToStatus();
}

// Exact poses of the flange in B as `from` has them.
std::vector<Reading> ReadingsOf(const Robot& robot, const Model& from,
                                const Eigen::VectorXd& lambda, int poses, Random* random) {
  std::vector<Reading> readings(poses);
  for (Reading& reading : readings) {
    reading.kind = ObservationKind::kPose;
    reading.q = DrawJoints(robot, random);
    reading.X_MT = Forward(from, reading.q, lambda);
  }
  return readings;
}

// `to` at nominal with the effects of `from`, and with its offsets of joints that are not solved
// for: dq of the first and last joint say where B and F stand when these have effects
// (core/calibrate/gauge.h), which is where compensation takes them to be.
Estimate StartOf(const Problem& problem, const Model& from, const Eigen::VectorXd& lambda,
                 const std::vector<int>& active) {
  Estimate start = NominalEstimate(problem);
  for (int i = 0; i < from.parameters.size(); ++i) {
    const Parameter& parameter = from.parameters[i];
    const auto same = problem.model->parameters.Find(parameter.name);
    if (!same) continue;
    const bool held =
        parameter.role == ParameterRole::kJointOffset &&
        !std::binary_search(active.begin(), active.end(), problem.FirstInternal() + *same);
    if (held || IsEffect(parameter)) start.lambda(*same) = lambda(i);
  }
  return start;
}

std::vector<int> GeometricIdentifiable(const Problem& problem, const Robot& robot) {
  const ParameterSet candidates = Candidates(problem);
  std::vector<int> active = GenericIdentifiable(problem, robot).active;
  std::erase_if(active, [&](int index) { return IsEffect(candidates[index]); });
  return active;
}

PredictionGap WorstGap(const Problem& problem, const Estimate& estimate,
                       const std::vector<Reading>& readings) {
  PredictionGap worst;
  for (const Reading& reading : readings) {
    const Residual r = ResidualAt(problem, reading, estimate);
    worst.position_m = std::max(worst.position_m, r.head<3>().norm());
    worst.rotation_rad = std::max(worst.rotation_rad, r.tail<3>().norm());
  }
  return worst;
}

bool RanAway(const Model& from, const Eigen::VectorXd& lambda, const Model& to,
             const Eigen::VectorXd& converted) {
  return LargestValue(to, converted) >
         kRunaway * std::max(LargestValue(from, lambda), kSmallestError);
}

// The solution's frames stand between those of `from`: X_MB' = X_MB G, X_FT' = H X_FT.
Estimate WithFrames(const Estimate& calibration, const Estimate& solved) {
  Estimate estimate = calibration;
  for (Pose& X_MB : estimate.X_MB) X_MB = X_MB * solved.X_MB[0];
  for (Pose& X_FT : estimate.X_FT) X_FT = solved.X_FT[0] * X_FT;
  estimate.lambda = solved.lambda;
  return estimate;
}

}  // namespace

absl::StatusOr<Conversion> ConvertCalibration(const Robot& robot, const Model& from,
                                              const Estimate& calibration, const Model& to) {
  TRUEPOSE_RETURN_IF_ERROR(CheckInput(robot, from, calibration.lambda, to));
  Random random(20260301);
  Problem problem{
      &to, ReadingsOf(robot, from, calibration.lambda, kSolvedPoses, &random), {""}, {""}};
  const std::vector<Reading> checked =
      ReadingsOf(robot, from, calibration.lambda, kCheckedPoses, &random);
  const std::vector<int> active = GeometricIdentifiable(problem, robot);
  const Estimate start = StartOf(problem, from, calibration.lambda, active);
  Estimate solved = start;
  Solve(problem, ModelError{}, active, {}, {}, &solved);
  const PredictionGap worst = WorstGap(problem, solved, checked);
  if (!(worst.position_m < kSamePosition && worst.rotation_rad < kSameRotation) ||
      RanAway(from, calibration.lambda, to, solved.lambda)) {
    return SingularLink({robot, from, calibration.lambda, problem, active, start, solved, worst});
  }
  Conversion conversion{WithFrames(calibration, solved), worst, {}};
  for (int index : active) {
    if (index >= problem.FirstInternal())
      conversion.solved.push_back(index - problem.FirstInternal());
  }
  return conversion;
}

}  // namespace truepose
