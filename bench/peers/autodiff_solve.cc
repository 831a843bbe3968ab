#include "bench/peers/autodiff_solve.h"

#include <cmath>

#include <Eigen/Geometry>
#include <ceres/ceres.h>
#include <ceres/rotation.h>

namespace truepose::bench {
namespace {

constexpr int kJoints = 6;
constexpr int kParameters = 4 + 5 * kJoints + 6;
// The residuals' spread at the truth (arm6): weights that a user would read off a first fit.
constexpr double kPositionSd = 0.153e-3 / 1.732, kRotationSd = 0.328e-3 / 1.732;

template <typename T>
struct Rigid {
  Eigen::Matrix<T, 3, 3> R = Eigen::Matrix<T, 3, 3>::Identity();
  Eigen::Matrix<T, 3, 1> p = Eigen::Matrix<T, 3, 1>::Zero();
};

// X * R(axis, angle), touching the two columns that change: a full product of matrices of Jets takes three times as long.
template <typename T>
void Turn(int axis, const T& angle, Rigid<T>* X) {
  using std::cos;
  using std::sin;
  const T c = cos(angle), s = sin(angle);
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const Eigen::Matrix<T, 3, 1> a = X->R.col(i), b = X->R.col(j);
  X->R.col(i) = a * c + b * s;
  X->R.col(j) = b * c - a * s;
}

template <typename T>
void Shift(int axis, const T& length, Rigid<T>* X) {
  X->p += X->R.col(axis) * length;
}

template <typename T>
void Link(const T* p, double q, Rigid<T>* X) {
  Turn<T>(2, p[0] + q, X);
  Shift(2, p[1], X);
  Shift(0, p[2], X);
  Turn(0, p[3], X);
  Turn(1, p[4], X);
}

template <typename T>
Rigid<T> ToolPose(const T* p, const double* q) {
  Rigid<T> X;
  Shift(0, p[0], &X);
  Shift(1, p[1], &X);
  Turn(0, p[2], &X);
  Turn(1, p[3], &X);
  for (int i = 0; i < kJoints; ++i) Link(p + 4 + 5 * i, q[i], &X);
  const T* tool = p + 4 + 5 * kJoints;
  for (int axis = 0; axis < 3; ++axis) Shift(axis, tool[axis], &X);
  for (int axis = 0; axis < 3; ++axis) Turn(axis, tool[3 + axis], &X);
  return X;
}

struct PoseCost {
  const MeasuredPose* measured;

  template <typename T>
  bool operator()(const T* parameters, T* residual) const {
    const Rigid<T> predicted = ToolPose<T>(parameters, measured->q.data());
    const auto& w = measured->wxyz;
    const Eigen::Matrix<T, 3, 3> R = Eigen::Quaterniond(w[0], w[1], w[2], w[3]).normalized().toRotationMatrix().cast<T>();
    const Eigen::Matrix<T, 3, 3> difference = R * predicted.R.transpose();
    ceres::RotationMatrixToAngleAxis(difference.data(), residual + 3);
    for (int k = 0; k < 3; ++k) {
      residual[k] = (measured->p_m[k] - predicted.p[k]) / kPositionSd;
      residual[3 + k] /= T(kRotationSd);
    }
    return true;
  }
};

std::vector<int> Fixed(const SharedProblem& problem) {
  std::vector<int> fixed;
  for (int i = 0; i < kParameters; ++i) {
    if (!problem.free[i]) fixed.push_back(i);
  }
  return fixed;
}

}  // namespace

std::vector<double> AutodiffSolve(const SharedProblem& problem) {
  std::vector<double> parameters = problem.nominal;
  ceres::Problem ceres_problem;
  for (const MeasuredPose& pose : problem.poses) {
    ceres_problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<PoseCost, 6, kParameters>(new PoseCost{&pose}), nullptr, parameters.data());
  }
  ceres_problem.SetManifold(parameters.data(), new ceres::SubsetManifold(kParameters, Fixed(problem)));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
  return parameters;
}

std::array<double, 3> TipOf(const std::vector<double>& parameters, const std::vector<double>& q) {
  const Eigen::Vector3d p = ToolPose<double>(parameters.data(), q.data()).p;
  return {p.x(), p.y(), p.z()};
}

}  // namespace truepose::bench
