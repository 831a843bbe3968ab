#include "core/identification/candidate_values.h"

namespace truepose {
namespace {

// Products of rotations drift from orthogonality, so the nearest rotation is taken.
Pose Moved(const Pose& frame, const double* corrections) {
  Pose moved = Corrected(frame, corrections, nullptr);
  moved.R = NearestRotation(moved.R);
  return moved;
}

}  // namespace

Eigen::VectorXd ValuesOf(const Problem& problem, const Estimate& start) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(problem.CandidateCount());
  values.segment(problem.FirstOfOffsets(), start.offsets.size()) = start.offsets;
  values.tail(start.lambda.size()) = start.lambda;
  return values;
}

Estimate EstimateAt(const Problem& problem, const Estimate& start, const Eigen::VectorXd& values) {
  Estimate estimate = start;
  for (int i = 0; i < problem.placement_count(); ++i)
    estimate.X_MB[i] = Moved(start.X_MB[i], values.data() + problem.FirstOfBase(i));
  for (int i = 0; i < problem.target_count(); ++i)
    estimate.X_FT[i] = Moved(start.X_FT[i], values.data() + problem.FirstOfTool(i));
  estimate.offsets = values.segment(problem.FirstOfOffsets(), start.offsets.size());
  estimate.lambda = values.tail(start.lambda.size());
  return estimate;
}

ReadingPoint PointAt(const Problem& problem, const Reading& reading, const Estimate& start,
                     const Eigen::VectorXd& values) {
  return {&start.X_MB[reading.placement],
          &start.X_FT[reading.target],
          values.data() + problem.FirstOfBase(reading.placement),
          values.data() + problem.FirstOfTool(reading.target),
          reading.offset >= 0 ? values(problem.FirstOfOffsets() + reading.offset) : 0,
          values.data() + problem.FirstInternal()};
}

}  // namespace truepose
