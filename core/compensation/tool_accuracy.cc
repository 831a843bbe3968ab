#include "core/compensation/tool_accuracy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace truepose {
namespace {

constexpr double kNormal95 = 1.6448536269514722;  // the 95 % quantile of a standard normal variable
constexpr int kBisections = 50;                   // to the last bits of a radius

// |e|^2 is taken as `scale` times chi-square of `freedom` degrees, whose cubic root over its own
// mean is nearly normal with mean 1 - c and variance c, c = 2 / (9 freedom).
struct Scaled {
  double scale, freedom;
  double c() const { return 2 / (9 * freedom); }
};

Scaled ScaledOf(const Eigen::Matrix3d& S) {
  const double trace = S.trace(), squares = S.squaredNorm();
  return {squares / trace, trace * trace / squares};
}

double ProbabilityWithin(double radius, const Eigen::Matrix3d& S) {
  if (!(S.trace() > 0)) return 1;
  const Scaled scaled = ScaledOf(S);
  const double root = std::cbrt(radius * radius / (scaled.scale * scaled.freedom));
  const double normal = (root - (1 - scaled.c())) / std::sqrt(scaled.c());
  return std::erfc(-normal / std::numbers::sqrt2) / 2;
}

// T's position in B by the active parameters.
Eigen::Matrix3Xd PositionJacobian(const AccuracySources& sources, const JointVector& q_chain,
                                  const Eigen::Vector3d& p_F_tool) {
  ModelSweep sweep;
  RunSweep(*sources.model, q_chain.data(), sources.lambda.data(), {}, &sweep);
  const Eigen::Vector3d p_BT = sweep.X_BF * p_F_tool;
  Eigen::Matrix3Xd J(3, sources.active.size());
  for (Eigen::Index i = 0; i < J.cols(); ++i)
    J.col(i) = TwistAt(p_BT, sweep.J_parameters.col(sources.active[static_cast<size_t>(i)]))
                   .template head<3>();
  return J;
}

Eigen::Matrix3d Unexplained(const AccuracySources& sources, const Eigen::Matrix3d& R_BF,
                            const Eigen::Vector3d& p_F_tool) {
  const Eigen::Vector3d d = R_BF * (p_F_tool - sources.p_F_target);
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  return sources.unexplained_m * sources.unexplained_m * I +
         sources.unexplained_rad * sources.unexplained_rad *
             (d.squaredNorm() * I - d * d.transpose());
}

}  // namespace

ToolAccuracy AccuracyAt(const AccuracySources& sources, const JointVector& q_chain,
                        const Eigen::Vector3d& p_F_tool) {
  const Eigen::Matrix3Xd J = PositionJacobian(sources, q_chain, p_F_tool);
  const Eigen::Matrix3d R_BF = Forward(*sources.model, q_chain, sources.lambda).R;
  const Eigen::Matrix3d of_parameters = J * sources.covariance * J.transpose();
  const Eigen::Matrix3d unexplained = Unexplained(sources, R_BF, p_F_tool);
  const Eigen::Matrix3d repeatability =
      sources.repeatability_m * sources.repeatability_m * Eigen::Matrix3d::Identity();
  ToolAccuracy accuracy;
  accuracy.covariance = of_parameters + unexplained + repeatability;
  accuracy.rms_m = std::sqrt(accuracy.covariance.trace());
  accuracy.parameters_m = std::sqrt(std::max(0.0, of_parameters.trace()));
  accuracy.unexplained_m = std::sqrt(unexplained.trace());
  accuracy.repeatability_m = std::sqrt(repeatability.trace());
  accuracy.position_95_m = Radius95(accuracy.covariance);
  return accuracy;
}

double Radius95(const Eigen::Matrix3d& S) {
  if (!(S.trace() > 0)) return 0;
  const Scaled scaled = ScaledOf(S);
  const double root = 1 - scaled.c() + kNormal95 * std::sqrt(scaled.c());
  return std::sqrt(scaled.scale * scaled.freedom * root * root * root);
}

double DeviationOfRepeatability(double iso_rp_m) {
  constexpr double kMean = 8 / std::numbers::pi;
  return iso_rp_m / (std::sqrt(kMean) + 3 * std::sqrt(3 - kMean));
}

double Radius95(const std::vector<Eigen::Matrix3d>& covariances) {
  double low = 0, high = 0;
  for (const Eigen::Matrix3d& S : covariances) high = std::max(high, Radius95(S));
  for (int i = 0; i < kBisections; ++i) {
    const double middle = (low + high) / 2;
    double inside = 0;
    for (const Eigen::Matrix3d& S : covariances) inside += ProbabilityWithin(middle, S);
    (inside < 0.95 * static_cast<double>(covariances.size()) ? low : high) = middle;
  }
  return high;
}

}  // namespace truepose
