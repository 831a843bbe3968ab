#include <algorithm>

#include "core/base/random.h"
#include "core/identification/identifiability.h"

namespace truepose {
namespace {

// Enough readings that even points alone (3 rows) give twice as many rows as there are candidates.
int GenericReadingCount(const Problem& problem) { return 20 + 2 * problem.CandidateCount() / 3; }

Reading DrawReading(const Robot& robot, ObservationKind kind, Random* random) {
  Reading reading;
  Eigen::VectorXd q = robot.MiddleOfLimits();
  for (int i = 0; i < robot.joint_count(); ++i) {
    const double range = robot.joints()[i].type == JointType::kRevolute ? 1.5 : 0.3;
    q(i) += random->Uniform(-range, range);
  }
  reading.q = robot.joint_map().ToChain(q);
  reading.kind = kind;
  return reading;
}

std::vector<ObservationKind> KindsOf(const Problem& problem) {
  std::vector<ObservationKind> kinds;
  for (const Reading& reading : problem.readings) {
    if (std::find(kinds.begin(), kinds.end(), reading.kind) == kinds.end())
      kinds.push_back(reading.kind);
  }
  return kinds;
}

// A residual of zero everywhere: derivatives of rotation residuals are then free of the residual's
// own size.
void MeasureExactly(const Problem& problem, const Estimate& estimate, Reading* reading) {
  reading->X_MT = estimate.X_MB[0] *
                  Forward<double>(problem.model->chain, reading->q.data(), estimate.lambda.data()) *
                  estimate.X_FT[0];
  reading->axis_M = reading->X_MT.R.col(2);
}

}  // namespace

IdentifiableSet GenericIdentifiable(const Problem& problem, const Robot& robot) {
  Problem generic{problem.model, {}, {""}, {""}};
  Estimate estimate = NominalEstimate(generic);
  // A target off the last axis and askew: on the axis fewer parameters would show (chapter-notes
  // 10).
  estimate.X_FT[0] = {ExpRotation<double>({0.3, -0.5, 0.2}), Eigen::Vector3d(0.05, -0.07, 0.11)};
  Random random(20260101);
  const std::vector<ObservationKind> kinds = KindsOf(problem);
  for (int i = 0; i < GenericReadingCount(generic); ++i) {
    generic.readings.push_back(DrawReading(robot, kinds[i % kinds.size()], &random));
    MeasureExactly(generic, estimate, &generic.readings.back());
  }
  IdentifiabilityOptions options;
  options.use_sd_bounds = false;
  IdentifiableSet set =
      Identifiable(Whitened(generic, estimate, ModelError{}).J, Candidates(generic), options);
  for (NullRelation& relation : set.redundancies) relation.structural = true;
  return set;
}

}  // namespace truepose
