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

}  // namespace

void EvaluateReading(const Model& model, const Reading& reading, const Pose& X_MB0,
                     const Pose& X_FT0, const double* base, const double* tool,
                     const double* internal, Workspace* workspace, Residual* r,
                     ReadingJacobian* J) {
  if (J == nullptr) {
    const Pose X_MT = Corrected(X_MB0, base, nullptr) *
                      Forward<double>(model.chain, reading.q.data(), internal) *
                      Corrected(X_FT0, tool, nullptr);
    KindOf(reading.kind).evaluate(reading, X_MT, r, nullptr);
    return;
  }
  FrameJacobian base_twists, tool_twists;
  const Pose X_MB = Corrected(X_MB0, base, &base_twists),
             X_FT = Corrected(X_FT0, tool, &tool_twists);
  RunSweep(model.chain, reading.q.data(), internal, &workspace->sweep);
  const Pose X_MF = X_MB * workspace->sweep.X_0E, X_MT = X_MF * X_FT;
  ResidualByTwist D;
  KindOf(reading.kind).evaluate(reading, X_MT, r, &D);
  MoveTwists(Pose{}, X_MT.p, base_twists, &workspace->twists);
  J->base = D * workspace->twists;
  MoveTwists(X_MF, X_MT.p, tool_twists, &workspace->twists);
  J->tool = D * workspace->twists;
  MoveTwists(X_MB, X_MT.p, workspace->sweep.J_parameters, &workspace->twists);
  J->internal = D * workspace->twists;
}

Pose Predict(const Problem& problem, const Reading& reading, const Estimate& estimate) {
  return estimate.X_MB[reading.placement] *
         Forward<double>(problem.model->chain, reading.q.data(), estimate.lambda.data()) *
         estimate.X_FT[reading.target];
}

Residual ResidualAt(const Problem& problem, const Reading& reading, const Estimate& estimate) {
  Residual r;
  KindOf(reading.kind).evaluate(reading, Predict(problem, reading, estimate), &r, nullptr);
  return r;
}

}  // namespace truepose
