#include "core/conversion/conversion_jacobian.h"

#include <Eigen/Dense>
#include <numeric>

#include "core/conversion/draw_joints.h"
#include "core/identification/prediction.h"

namespace truepose {
namespace {

// Six rows each: the first pair of frames determines the internal parameters, each further one only
// its own frame.
constexpr int kPoses = 60, kPosesOfFurtherFrame = 10;

// Exact full poses as `from` predicts them, of the first target at every placement and of every
// target at the first placement.
std::vector<Reading> PosesOf(const Robot& robot, const ConversionSide& from) {
  Random random(20260302);
  std::vector<Reading> readings;
  const auto add = [&](int placement, int target, int poses) {
    for (int i = 0; i < poses; ++i) {
      Reading reading;
      reading.kind = ObservationKind::kPose;
      reading.q = DrawJoints(robot, &random);
      reading.placement = placement;
      reading.target = target;
      reading.X_MT = Predict(from.problem, reading, from.estimate);
      readings.push_back(std::move(reading));
    }
  };
  add(0, 0, kPoses);
  for (int p = 1; p < from.problem.placement_count(); ++p) add(p, 0, kPosesOfFurtherFrame);
  for (int t = 1; t < from.problem.target_count(); ++t) add(0, t, kPosesOfFurtherFrame);
  return readings;
}

// Residuals of the poses by all candidates of one side; residuals are zero on both sides, so these
// are derivatives of the prediction, up to the sign that both share.
Eigen::MatrixXd JacobianOf(const ConversionSide& side, const std::vector<Reading>& readings) {
  const Problem& problem = side.problem;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(readings.size()),
                                            problem.CandidateCount());
  Workspace workspace;
  for (size_t i = 0; i < readings.size(); ++i) {
    Residual r;
    ReadingJacobian of_reading;
    EvaluateReading(*problem.model, readings[i], PointOf(readings[i], side.estimate), &workspace,
                    &r, &of_reading);
    auto rows = J.middleRows<6>(6 * static_cast<Eigen::Index>(i));
    rows.middleCols<6>(problem.FirstOfBase(readings[i].placement)) = of_reading.base;
    rows.middleCols<6>(problem.FirstOfTool(readings[i].target)) = of_reading.tool;
    rows.rightCols(problem.model->parameters.size()) = of_reading.internal;
  }
  return J;
}

// Base and tool, and the internal parameters that were solved for.
std::vector<int> TakingPart(const Problem& to, const std::vector<int>& solved) {
  std::vector<int> active(to.FirstOfOffsets());
  std::iota(active.begin(), active.end(), 0);
  for (int index : solved) active.push_back(to.FirstInternal() + index);
  return active;
}

// Constants of distances and effects are the same quantities on both sides.
bool IsKept(const Parameter& parameter) {
  return parameter.group == ParameterGroup::kInstrument || parameter.role == ParameterRole::kEffect;
}

void KeepOthers(const ParameterSet& from, const ParameterSet& to, Eigen::MatrixXd* T) {
  for (int column = 0; column < from.size(); ++column) {
    if (!IsKept(from[column])) continue;
    T->col(column).setZero();
    if (const auto row = to.Find(from[column].name)) (*T)(*row, column) = 1;
  }
}

}  // namespace

Eigen::MatrixXd ConversionJacobian(const Robot& robot, const ConversionSide& from,
                                   const ConversionSide& to, const std::vector<int>& solved) {
  const std::vector<Reading> readings = PosesOf(robot, from);
  const std::vector<int> active = TakingPart(to.problem, solved);
  const Eigen::MatrixXd of_to = JacobianOf(to, readings)(Eigen::all, active);
  const Eigen::MatrixXd of_from = JacobianOf(from, readings);
  Eigen::MatrixXd T =
      Eigen::MatrixXd::Zero(to.problem.CandidateCount(), from.problem.CandidateCount());
  T(active, Eigen::all) = of_to.colPivHouseholderQr().solve(of_from);
  KeepOthers(Candidates(from.problem), Candidates(to.problem), &T);
  return T;
}

}  // namespace truepose
