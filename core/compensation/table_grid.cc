#include "core/compensation/table_grid.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace truepose {
namespace {

using compensation::Arm;
using compensation::PoseError;

constexpr int kProbes = 64, kProbesAlong = 4;
constexpr double kDoesNotMatter = 1e-3;  // of the tolerances
constexpr int kCurvaturePoints = 2000;
// Of second differences: their own error, h^2 / 12 of the fourth derivative, is below 1e-4, and
// rounding of poses of 1 m to 1e-16 leaves 1e-12 of it.
constexpr double kDifference = 0.02;  // rad or m
// So many nodes along one coordinate belong to no table of 64 MiB that has a second one.
constexpr double kMostAlong = 1e6;

Twist TwistAtU(const Arm& arm, const TableAxes& axes, const JointVector& u) {
  const JointVector q = axes.ToController(u);
  return CorrectionTwist(arm, q.data());
}

Eigen::Vector3d FlangeAtU(const Arm& arm, const TableAxes& axes, const JointVector& u) {
  const int n = axes.joints();
  const double q_last =
      arm.joint_scale.row(n - 1).head(n).dot(axes.ToController(u)) + arm.joint_offset(n - 1);
  return FlangeInL(arm, q_last);
}

// How far delta at u moves the flange, at most, from where it does at other values of u_k.
double VariationAlong(const Arm& arm, const TableDomain& domain, int k, JointVector u,
                      const ToleranceUnits& units, Random* random) {
  const Twist here = TwistAtU(arm, domain.axes, u);
  double largest = 0;
  for (int i = 0; i < kProbesAlong; ++i) {
    const AxisRange& range = domain.range[static_cast<size_t>(k)];
    u(k) = random->Uniform(range.lower, range.upper);
    const Twist change = TwistAtU(arm, domain.axes, u) - here;
    largest = std::max(largest, units.SizeOf(FlangeMotion(change, FlangeAtU(arm, domain.axes, u))));
  }
  return largest;
}

Curvature CurvatureAt(const Arm& arm, const TableDomain& domain, const std::vector<bool>& folded,
                      const JointVector& u) {
  const Twist twice = 2 * TwistAtU(arm, domain.axes, u);
  const Eigen::Vector3d p_LF = FlangeAtU(arm, domain.axes, u);
  Curvature curvature;
  for (int k = 0; k < u.size(); ++k) {
    if (folded[static_cast<size_t>(k)]) continue;
    const JointVector d = kDifference * JointVector::Unit(u.size(), k);
    const Twist difference =
        TwistAtU(arm, domain.axes, u + d) - twice + TwistAtU(arm, domain.axes, u - d);
    curvature.push_back(FlangeMotion(difference / (kDifference * kDifference), p_LF));
  }
  return curvature;
}

// The worst sums over the subsets of coordinates, for position and rotation each.
PoseError WorstOfCell(const Curvature& curvature, const std::vector<double>& steps) {
  const size_t count = curvature.size();
  PoseError worst;
  for (size_t subset = 1; subset < size_t{1} << count; ++subset) {
    Twist sum = Twist::Zero();
    for (size_t k = 0; k < count; ++k)
      if (subset >> k & 1) sum += steps[k] * steps[k] / 8 * curvature[k];
    worst.position_m = std::max(worst.position_m, sum.head<3>().norm());
    worst.rotation_rad = std::max(worst.rotation_rad, sum.tail<3>().norm());
  }
  return worst;
}

// 1 / sqrt(M_k): steps of equal shares, up to one common factor.
std::vector<double> RelativeSteps(const std::vector<Curvature>& curvatures,
                                  const ToleranceUnits& units) {
  std::vector<double> steps(curvatures.front().size());
  for (size_t k = 0; k < steps.size(); ++k) {
    double largest = 0;
    for (const Curvature& curvature : curvatures)
      largest = std::max(largest, units.SizeOf(curvature[k]));
    steps[k] = 1 / std::sqrt(std::max(largest, 1e-9));  // linear in u_k: two nodes do
  }
  return steps;
}

double WidthOf(const TableDomain& domain, size_t k) {
  return domain.range[k].width() + 2 * domain.margin[k];
}

// Steps that are at most `steps`, such that an even number of them fill each range.
std::vector<int> NodesOf(const TableDomain& domain, const std::vector<bool>& folded,
                         const std::vector<double>& steps) {
  std::vector<int> nodes(folded.size(), 1);
  for (size_t k = 0, unfolded = 0; k < folded.size(); ++k) {
    if (folded[k]) continue;
    const double cells = std::ceil(WidthOf(domain, k) / steps[unfolded++]);
    nodes[k] = 1 + static_cast<int>(std::clamp(cells, 1.0, kMostAlong));
  }
  return nodes;
}

std::vector<double> StepsOf(const TableDomain& domain, const std::vector<int>& nodes) {
  std::vector<double> steps;
  for (size_t k = 0; k < nodes.size(); ++k)
    if (nodes[k] > 1) steps.push_back(WidthOf(domain, k) / (nodes[k] - 1));
  return steps;
}

}  // namespace

std::vector<bool> FoldedAxes(const Arm& arm, const TableDomain& domain, const ToleranceUnits& units,
                             uint64_t seed) {
  Random random(seed);
  std::vector<bool> folded;
  for (int k = 0; k < domain.axes.joints(); ++k) {
    double largest = 0;
    for (int i = 0; i < kProbes; ++i)
      largest = std::max(largest,
                         VariationAlong(arm, domain, k, DrawIn(domain, &random), units, &random));
    folded.push_back(largest < kDoesNotMatter);
  }
  return folded;
}

std::vector<Curvature> CurvaturesOf(const Arm& arm, const TableDomain& domain,
                                    const std::vector<bool>& folded, uint64_t seed) {
  Random random(seed);
  std::vector<Curvature> curvatures;
  for (int i = 0; i < kCurvaturePoints; ++i)
    curvatures.push_back(CurvatureAt(arm, domain, folded, DrawIn(domain, &random)));
  return curvatures;
}

PoseError InterpolationError(const std::vector<Curvature>& curvatures,
                             const std::vector<double>& steps) {
  PoseError worst;
  for (const Curvature& curvature : curvatures) {
    const PoseError here = WorstOfCell(curvature, steps);
    worst.position_m = std::max(worst.position_m, here.position_m);
    worst.rotation_rad = std::max(worst.rotation_rad, here.rotation_rad);
  }
  return worst;
}

// The error grows with the square of a common factor of the steps, so one look gives the factor;
// rounding counts up then only lowers it.
std::vector<int> ChooseNodes(const TableDomain& domain, const std::vector<bool>& folded,
                             const std::vector<Curvature>& curvatures, const ToleranceUnits& units,
                             double share) {
  std::vector<double> steps = RelativeSteps(curvatures, units);
  const PoseError error = InterpolationError(curvatures, steps);
  const double of_tolerance =
      std::max(error.position_m / units.position_m, error.rotation_rad / units.rotation_rad);
  const double factor = std::sqrt(share / std::max(of_tolerance, 1e-30));
  for (double& step : steps) step *= factor;
  return NodesOf(domain, folded, steps);
}

PoseError ErrorOf(const TableDomain& domain, const std::vector<int>& nodes,
                  const std::vector<Curvature>& curvatures) {
  return InterpolationError(curvatures, StepsOf(domain, nodes));
}

double NodeCount(const std::vector<int>& nodes) {
  double count = 1;
  for (int n : nodes) count *= n;
  return count;
}

}  // namespace truepose
