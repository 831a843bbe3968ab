#include "bench/peers/autodiff_solve.h"

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
using Transform = Eigen::Transform<T, 3, Eigen::Isometry>;

template <typename T>
Transform<T> Turn(const T& angle, const Eigen::Vector3d& axis) {
  return Transform<T>(Eigen::AngleAxis<T>(angle, axis.cast<T>()));
}

template <typename T>
Transform<T> Shift(const T& x, const T& y, const T& z) {
  return Transform<T>(Eigen::Translation<T, 3>(x, y, z));
}

template <typename T>
Transform<T> Link(const T* p, double q) {
  const auto X = Eigen::Vector3d::UnitX(), Y = Eigen::Vector3d::UnitY(), Z = Eigen::Vector3d::UnitZ();
  return Turn<T>(p[0] + q, Z) * Shift<T>(p[2], T(0), p[1]) * Turn<T>(p[3], X) *
         Turn<T>(p[4], Y);
}

template <typename T>
Transform<T> ToolPose(const T* p, const double* q) {
  const auto X = Eigen::Vector3d::UnitX(), Y = Eigen::Vector3d::UnitY(), Z = Eigen::Vector3d::UnitZ();
  Transform<T> pose = Shift<T>(p[0], p[1], T(0)) * Turn<T>(p[2], X) * Turn<T>(p[3], Y);
  for (int i = 0; i < kJoints; ++i) pose = pose * Link<T>(p + 4 + 5 * i, q[i]);
  const T* tool = p + 4 + 5 * kJoints;
  return pose * Shift<T>(tool[0], tool[1], tool[2]) * Turn<T>(tool[3], X) * Turn<T>(tool[4], Y) * Turn<T>(tool[5], Z);
}

struct PoseCost {
  const MeasuredPose* measured;

  template <typename T>
  bool operator()(const T* parameters, T* residual) const {
    const Transform<T> predicted = ToolPose<T>(parameters, measured->q.data());
    const auto& w = measured->wxyz;
    const Eigen::Matrix<T, 3, 3> R = Eigen::Quaterniond(w[0], w[1], w[2], w[3]).normalized().toRotationMatrix().cast<T>();
    const Eigen::Matrix<T, 3, 3> difference = R * predicted.linear().transpose();
    ceres::RotationMatrixToAngleAxis(difference.data(), residual + 3);
    for (int k = 0; k < 3; ++k) {
      residual[k] = (measured->p_m[k] - predicted.translation()[k]) / kPositionSd;
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
  const Eigen::Vector3d p = ToolPose<double>(parameters.data(), q.data()).translation();
  return {p.x(), p.y(), p.z()};
}

}  // namespace truepose::bench
