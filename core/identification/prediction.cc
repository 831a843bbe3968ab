#include "core/identification/prediction.h"

#include <array>

namespace truepose {
namespace {

constexpr std::array<double, kFrameParameters> kNoCorrection = {};

// Columns in frame A, expressed as velocity of the tool point and angular velocity in M. @param p_T
// tool point in M.
void MoveTwists(const Pose& X_MA, const Eigen::Vector3d& p_T,
                const Eigen::Ref<const Eigen::Matrix<double, 6, Eigen::Dynamic>>& twists_A,
                Eigen::Matrix<double, 6, Eigen::Dynamic>* twists_M) {
  const Eigen::Vector3d arm = p_T - X_MA.p;
  twists_M->resize(6, twists_A.cols());
  for (Eigen::Index i = 0; i < twists_A.cols(); ++i) {
    const Eigen::Vector3d w = X_MA.R * twists_A.col(i).tail<3>();
    twists_M->col(i) << X_MA.R * twists_A.col(i).head<3>() + w.cross(arm), w;
  }
}

// A distance is predicted longer by its unknown constant.
void SubtractOffset(const Reading& reading, double offset, Residual* r) {
  if (reading.offset >= 0) (*r)(0) -= offset;
}

void EvaluateResidual(const Model& model, const Reading& reading, const ReadingPoint& at,
                      Residual* r) {
  const Eigen::VectorXd lambda =
      Eigen::Map<const Eigen::VectorXd>(at.internal, model.parameters.size());
  const Pose X_MT = Corrected(*at.X_MB, at.base, nullptr) *
                    Forward(model, reading.q, lambda, reading.conditions) *
                    Corrected(*at.X_FT, at.tool, nullptr);
  KindOf(reading.kind).evaluate(reading, X_MT, r, nullptr);
  SubtractOffset(reading, at.offset, r);
}

}  // namespace

void EvaluateReading(const Model& model, const Reading& reading, const ReadingPoint& at,
                     Workspace* workspace, Residual* r, ReadingJacobian* J) {
  if (J == nullptr) return EvaluateResidual(model, reading, at, r);
  FrameJacobian base_twists, tool_twists;
  const Pose X_MB = Corrected(*at.X_MB, at.base, &base_twists),
             X_FT = Corrected(*at.X_FT, at.tool, &tool_twists);
  RunSweep(model, reading.q.data(), at.internal, reading.conditions, &workspace->sweep);
  const Pose X_MF = X_MB * workspace->sweep.X_BF, X_MT = X_MF * X_FT;
  ResidualByTwist D;
  KindOf(reading.kind).evaluate(reading, X_MT, r, &D);
  SubtractOffset(reading, at.offset, r);
  MoveTwists(Pose{}, X_MT.p, base_twists, &workspace->twists);
  J->base = D * workspace->twists;
  MoveTwists(X_MF, X_MT.p, tool_twists, &workspace->twists);
  J->tool = D * workspace->twists;
  MoveTwists(X_MB, X_MT.p, workspace->sweep.J_parameters, &workspace->twists);
  J->internal = D * workspace->twists;
  J->offset.setConstant(r->size(), 1, reading.offset >= 0 ? -1 : 0);
}

ReadingPoint PointOf(const Reading& reading, const Estimate& estimate) {
  return {&estimate.X_MB[reading.placement],
          &estimate.X_FT[reading.target],
          kNoCorrection.data(),
          kNoCorrection.data(),
          reading.offset >= 0 ? estimate.offsets(reading.offset) : 0,
          estimate.lambda.data()};
}

Pose Predict(const Problem& problem, const Reading& reading, const Estimate& estimate) {
  return estimate.X_MB[reading.placement] *
         Forward(*problem.model, reading.q, estimate.lambda, reading.conditions) *
         estimate.X_FT[reading.target];
}

Residual ResidualAt(const Problem& problem, const Reading& reading, const Estimate& estimate) {
  Residual r;
  EvaluateReading(*problem.model, reading, PointOf(reading, estimate), nullptr, &r, nullptr);
  return r;
}

RowJacobian JointJacobian(const Problem& problem, const Reading& reading, const Estimate& estimate,
                          Workspace* workspace) {
  RunSweep(*problem.model, reading.q.data(), estimate.lambda.data(), reading.conditions,
           &workspace->sweep);
  const Pose& X_MB = estimate.X_MB[reading.placement];
  const Pose X_MT = X_MB * workspace->sweep.X_BF * estimate.X_FT[reading.target];
  Residual r;
  ResidualByTwist D;
  KindOf(reading.kind).evaluate(reading, X_MT, &r, &D);
  MoveTwists(X_MB, X_MT.p, workspace->sweep.J_joints, &workspace->twists);
  return D * workspace->twists;
}

}  // namespace truepose
