#include "core/calibrate/gauge.h"

#include <algorithm>

#include "absl/strings/str_cat.h"

namespace truepose {
namespace {

// Mean of what the effects add to a chain joint.
double MeanShift(const Problem& problem, const Eigen::VectorXd& lambda, int joint) {
  double sum = 0;
  for (const Reading& reading : problem.readings)
    sum += EffectShift(*problem.model, reading.q, lambda, reading.conditions)(joint);
  return sum / static_cast<double>(problem.readings.size());
}

// The parameter dq of a chain joint, when the gauge is free to set it; else -1.
int FreeOffset(const Problem& problem, const std::vector<int>& active, int joint) {
  const auto index = problem.model->parameters.Find(absl::StrCat("dq", joint + 1));
  if (!index) return -1;
  const bool identified =
      std::find(active.begin(), active.end(), problem.FirstInternal() + *index) != active.end();
  return identified ? -1 : *index;
}

// X_BF before and after the change of one parameter, at any reading.
struct Moved {
  Pose before, after;
};

Moved Move(const Problem& problem, int parameter, double value, Eigen::VectorXd* lambda) {
  const Reading& reading = problem.readings[0];
  Moved moved;
  moved.before = Forward(*problem.model, reading.q, *lambda, reading.conditions);
  (*lambda)(parameter) = value;
  moved.after = Forward(*problem.model, reading.q, *lambda, reading.conditions);
  return moved;
}

}  // namespace

void CentreEffects(const Problem& problem, const std::vector<int>& active, Estimate* estimate) {
  if (problem.model->effects.empty() || problem.readings.empty()) return;
  const int last = JointCount(problem.model->chain) - 1;
  const double first_mean = MeanShift(problem, estimate->lambda, 0),
               last_mean = MeanShift(problem, estimate->lambda, last);
  if (const int offset = FreeOffset(problem, active, 0); offset >= 0) {
    const Moved moved = Move(problem, offset, -first_mean, &estimate->lambda);
    for (Pose& X_MB : estimate->X_MB) X_MB = X_MB * moved.before * Inverse(moved.after);
  }
  if (const int offset = FreeOffset(problem, active, last); offset >= 0 && last > 0) {
    const Moved moved = Move(problem, offset, -last_mean, &estimate->lambda);
    for (Pose& X_FT : estimate->X_FT) X_FT = Inverse(moved.after) * moved.before * X_FT;
  }
}

}  // namespace truepose
