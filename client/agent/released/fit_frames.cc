#include "client/agent/released/fit_frames.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace truepose::agent {
namespace {

constexpr int kUnknowns = 12;  // turn of W, shift of W, turn of T, shift of T
constexpr int kMostSteps = 20;
constexpr double kSmallestStep = 1e-12;  // rad and m, below the rounding of poses
// Beyond it the sign of a rotation vector is up to noise.
constexpr double kLargestAngle = 3.0;

using Pairs = std::span<const PosePair>;

Eigen::Matrix3d Nearest(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d flip = Eigen::Matrix3d::Identity();
  flip(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixU() * flip * svd.matrixV().transpose();
}

Pose Predicted(const PosePair& pair, const Frames& frames) {
  return frames.X_WB * pair.X_BF * frames.X_FT;
}

Eigen::Matrix<double, 6, 1> Residual(const PosePair& pair, const Frames& frames) {
  const Pose predicted = Predicted(pair, frames);
  Eigen::Matrix<double, 6, 1> residual;
  residual << pair.X_WT.p - predicted.p, LogRotation<double>(pair.X_WT.R * predicted.R.transpose());
  return residual;
}

// By Exp(w) R_WB, p_WB + v, Exp(u) R_FT, p_FT + t: the predicted point moves with
// w x (X_WB X_BF p_FT - p_WB) + v + R_WF t, its frame turns with w + R_WF u.
Eigen::Matrix<double, 6, kUnknowns> JacobianAt(const PosePair& pair, const Frames& frames) {
  const Eigen::Matrix3d R_WF = frames.X_WB.R * pair.X_BF.R;
  const Eigen::Vector3d arm = Predicted(pair, frames).p - frames.X_WB.p;
  Eigen::Matrix<double, 6, kUnknowns> J = Eigen::Matrix<double, 6, kUnknowns>::Zero();
  J.block<3, 3>(0, 0) = -Hat<double>(arm);
  J.block<3, 3>(0, 3) = Eigen::Matrix3d::Identity();
  J.block<3, 3>(0, 9) = R_WF;
  J.block<3, 3>(3, 0) = Eigen::Matrix3d::Identity();
  J.block<3, 3>(3, 6) = R_WF;
  return J;
}

void Move(const Eigen::VectorXd& step, Frames& frames) {
  frames.X_WB.R = ExpRotation<double>(step.segment<3>(0)) * frames.X_WB.R;
  frames.X_WB.p += step.segment<3>(3);
  frames.X_FT.R = ExpRotation<double>(step.segment<3>(6)) * frames.X_FT.R;
  frames.X_FT.p += step.segment<3>(9);
}

// One Gauss-Newton step of least length. @returns how many of the unknowns are determined.
int Step(Pairs pairs, const PoseNoise& noise, Frames& frames, double* length) {
  const int rows = 6 * static_cast<int>(pairs.size());
  Eigen::MatrixXd J(rows, kUnknowns);
  Eigen::VectorXd r(rows);
  Eigen::Matrix<double, 6, 1> weight;
  weight << Eigen::Vector3d::Constant(1 / noise.position_m),
      Eigen::Vector3d::Constant(1 / noise.rotation_rad);
  for (size_t i = 0; i < pairs.size(); ++i) {
    const int row = 6 * static_cast<int>(i);
    J.middleRows<6>(row) = weight.asDiagonal() * JacobianAt(pairs[i], frames);
    r.segment<6>(row) = weight.cwiseProduct(Residual(pairs[i], frames));
  }
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(J);
  const Eigen::VectorXd step = solver.solve(r);
  Move(step, frames);
  *length = step.norm();
  return static_cast<int>(solver.rank());
}

FrameFit Refine(Pairs pairs, const PoseNoise& noise, Frames frames) {
  int determined = 0;
  double length = 1;
  for (int i = 0; i < kMostSteps && length > kSmallestStep; ++i)
    determined = Step(pairs, noise, frames, &length);
  FrameFit fit = ResidualsOf(pairs, noise, frames);
  fit.degrees_of_freedom -= determined;
  return fit;
}

// With R_WB the rest follows: R_FT by the orientations, both points by the first step, in which
// they are linear.
Frames StartAt(Pairs pairs, const Eigen::Matrix3d& R_WB) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const PosePair& pair : pairs) sum += (R_WB * pair.X_BF.R).transpose() * pair.X_WT.R;
  Frames frames;
  frames.X_WB.R = R_WB;
  frames.X_FT.R = Nearest(sum);
  return frames;
}

// R_WT_i R_WT_j^T = R_WB (R_BF_i R_BF_j^T) R_WB^T: the rotation vectors differ by R_WB.
Eigen::Matrix3d TurnByRotations(Pairs pairs) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (size_t i = 0; i < pairs.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const Eigen::Vector3d a = LogRotation<double>(pairs[i].X_WT.R * pairs[j].X_WT.R.transpose());
      const Eigen::Vector3d b = LogRotation<double>(pairs[i].X_BF.R * pairs[j].X_BF.R.transpose());
      if (std::max(a.norm(), b.norm()) < kLargestAngle) sum += a * b.transpose();
    }
  }
  return Nearest(sum);
}

// As if T stood at the flange.
Eigen::Matrix3d TurnByPositions(Pairs pairs) {
  Eigen::Vector3d mean_W = Eigen::Vector3d::Zero(), mean_B = mean_W;
  for (const PosePair& pair : pairs) {
    mean_W += pair.X_WT.p / static_cast<double>(pairs.size());
    mean_B += pair.X_BF.p / static_cast<double>(pairs.size());
  }
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const PosePair& pair : pairs)
    sum += (pair.X_WT.p - mean_W) * (pair.X_BF.p - mean_B).transpose();
  return Nearest(sum);
}

}  // namespace

FrameFit ResidualsOf(Pairs pairs, const PoseNoise& noise, const Frames& frames) {
  FrameFit fit{.frames = frames};
  double positions = 0, rotations = 0;
  for (const PosePair& pair : pairs) {
    const auto residual = Residual(pair, frames);
    positions += residual.head<3>().squaredNorm();
    rotations += residual.tail<3>().squaredNorm();
    fit.position_largest_m = std::max(fit.position_largest_m, residual.head<3>().norm());
  }
  const double count = static_cast<double>(pairs.size());
  fit.position_rms_m = std::sqrt(positions / count);
  fit.rotation_rms_rad = std::sqrt(rotations / count);
  fit.sum_of_squares = positions / (noise.position_m * noise.position_m) +
                       rotations / (noise.rotation_rad * noise.rotation_rad);
  fit.degrees_of_freedom = 6 * static_cast<int>(pairs.size());
  return fit;
}

FrameFit FitFrames(Pairs pairs, const PoseNoise& noise) {
  const FrameFit a = Refine(pairs, noise, StartAt(pairs, TurnByRotations(pairs)));
  const FrameFit b = Refine(pairs, noise, StartAt(pairs, TurnByPositions(pairs)));
  return a.sum_of_squares <= b.sum_of_squares ? a : b;
}

}  // namespace truepose::agent
