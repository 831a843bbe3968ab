#include <algorithm>

#include "core/base/random.h"
#include "core/identification/identifiability.h"
#include "core/identification/prediction.h"

namespace truepose {
namespace {

// Enough readings of each sort that even one row a reading (a distance) gives twice as many rows as
// one frame, one target and an arm of seven joints have candidates.
constexpr int kReadingsOfASort = 100;

// What makes readings differ in which parameters they show.
bool SameSort(const Reading& a, const Reading& b) {
  return a.placement == b.placement && a.target == b.target && a.kind == b.kind &&
         a.coordinates == b.coordinates && a.offset == b.offset && a.anchor_M == b.anchor_M &&
         a.normal_M == b.normal_M;
}

std::vector<const Reading*> Sorts(const Problem& problem) {
  std::vector<const Reading*> sorts;
  for (const Reading& reading : problem.readings) {
    if (std::none_of(sorts.begin(), sorts.end(),
                     [&](const Reading* known) { return SameSort(*known, reading); }))
      sorts.push_back(&reading);
  }
  return sorts;
}

Reading DrawReading(const Robot& robot, const Reading& sort, Random* random) {
  Reading reading = sort;
  Eigen::VectorXd q = robot.MiddleOfLimits();
  for (int i = 0; i < robot.joint_count(); ++i) {
    const double range = robot.joints()[i].type == JointType::kRevolute ? 1.5 : 0.3;
    q(i) += random->Uniform(-range, range);
  }
  reading.q = robot.joint_map().ToChain(q);
  reading.position_sd_m.setZero();
  reading.rotation_sd_rad = 0;
  reading.joint_sd.resize(0);
  reading.covariance.reset();
  reading.weight = 1;
  reading.conditions.temperature_K = random->Uniform(-10, 10);
  for (double& torque : reading.conditions.joint_torque) torque = random->Uniform(-100, 100);
  return reading;
}

// A residual of zero everywhere: derivatives of rotation residuals are then free of the residual's
// own size.
void MeasureExactly(const Problem& problem, const Estimate& estimate, Reading* reading) {
  reading->X_MT = Predict(problem, *reading, estimate);
  reading->axis_M = reading->X_MT.R.col(2);
  reading->distance_m = (reading->X_MT.p - reading->anchor_M).norm();
}

// A target off the last axis and askew (on the axis fewer parameters would show, chapter-notes 10),
// an instrument that stands beside the robot.
Estimate AnyFrames(const Problem& problem, Random* random) {
  Estimate estimate = NominalEstimate(problem);
  const auto draw = [&](double range) {
    return Eigen::Vector3d(random->Uniform(-range, range), random->Uniform(-range, range),
                           random->Uniform(-range, range));
  };
  for (Pose& X_MB : estimate.X_MB) X_MB = {ExpRotation<double>(draw(1)), draw(2)};
  for (Pose& X_FT : estimate.X_FT)
    X_FT = {ExpRotation<double>(draw(0.6)), Eigen::Vector3d(0.05, -0.07, 0.11) + draw(0.05)};
  return estimate;
}

}  // namespace

IdentifiableSet GenericIdentifiable(const Problem& problem, const Robot& robot) {
  Problem generic = problem;
  generic.readings.clear();
  generic.prior.reset();
  Random random(20260101);
  const Estimate estimate = AnyFrames(generic, &random);
  const std::vector<const Reading*> sorts = Sorts(problem);
  const int each = std::max(12, kReadingsOfASort / static_cast<int>(sorts.size()));
  for (const Reading* sort : sorts) {
    for (int i = 0; i < each; ++i) {
      generic.readings.push_back(DrawReading(robot, *sort, &random));
      MeasureExactly(generic, estimate, &generic.readings.back());
    }
  }
  IdentifiabilityOptions options;
  options.use_sd_bounds = false;
  IdentifiableSet set =
      Identifiable(Whitened(generic, estimate, ModelError{}).J, Candidates(generic), options);
  for (NullRelation& relation : set.redundancies) relation.structural = true;
  return set;
}

}  // namespace truepose
