#include "core/compensation/table_axes.h"

#include <Eigen/Dense>
#include <cmath>
#include <utility>

namespace truepose {
namespace {

using compensation::Arm;
using compensation::JointLimits;

// Axes that enclose less than this count as parallel: the shear that it leaves in the domain is
// below a millionth of its width.
constexpr double kParallel = 1e-6;

JointMatrix ScaleOf(const Arm& arm) {
  return arm.joint_scale.topLeftCorner(arm.nominal.joints, arm.nominal.joints);
}

// Of the turning joint before `joint`: its number, and +1 or -1 where its axis is parallel or
// opposite, else 0. Sliding joints between them turn nothing.
std::pair<int, double> ParallelBefore(const Arm& arm, int joint) {
  Eigen::Matrix3d R = arm.nominal.constant[static_cast<size_t>(joint)].R;
  int before = joint - 1;
  for (; before >= 0 && arm.nominal.prismatic[static_cast<size_t>(before)]; --before)
    R = arm.nominal.constant[static_cast<size_t>(before)].R * R;
  const bool parallel = R.col(2).head<2>().norm() < kParallel;
  return {before, before >= 0 && parallel ? std::copysign(1.0, R(2, 2)) : 0};
}

double WidthOf(const JointVector& row, const std::vector<JointVector>& samples) {
  AxisRange range{row.dot(samples.front()), row.dot(samples.front())};
  for (const JointVector& q : samples) {
    const double u = row.dot(q);
    range = {std::min(range.lower, u), std::max(range.upper, u)};
  }
  return range.width();
}

// The narrowest of the joint itself and its sums with the parallel joints before it.
JointVector NarrowestRow(const Arm& arm, int joint, const std::vector<JointVector>& samples) {
  JointVector row = JointVector::Unit(arm.nominal.joints, joint);
  JointVector narrowest = row;
  if (arm.nominal.prismatic[static_cast<size_t>(joint)]) return row;
  double width = WidthOf(row, samples), sign = 1;
  for (auto [before, along] = ParallelBefore(arm, joint); along != 0;) {
    sign *= along;
    row(before) = sign;
    const double sum = WidthOf(row, samples);
    if (sum < width) narrowest = row;
    width = std::min(width, sum);
    std::tie(before, along) = ParallelBefore(arm, before);
  }
  return narrowest;
}

}  // namespace

TableAxes::TableAxes(const Arm& arm, JointMatrix weight)
    : weight_(std::move(weight)),
      to_u_(weight_ * ScaleOf(arm)),
      from_u_(to_u_.inverse()),
      at_zero_(weight_ * arm.joint_offset.head(arm.nominal.joints)),
      prismatic_(arm.nominal.prismatic) {}

AxisRange TableAxes::Hull(int k, const std::vector<JointLimits>& ranges) const {
  AxisRange hull{at_zero_(k), at_zero_(k)};
  for (int j = 0; j < joints(); ++j) {
    const double share = to_u_(k, j);
    if (share == 0) continue;
    const JointLimits& range = ranges[static_cast<size_t>(j)];
    hull.lower += share > 0 ? share * range.lower : share * range.upper;
    hull.upper += share > 0 ? share * range.upper : share * range.lower;
  }
  return hull;
}

bool TableAxes::IsLength(int k) const {
  for (int j = 0; j < joints(); ++j)
    if (weight_(k, j) != 0 && !prismatic_[static_cast<size_t>(j)]) return false;
  return true;
}

JointMatrix WeightOfControllerJoints(const Arm& arm) {
  const JointMatrix inverse = ScaleOf(arm).inverse();
  const JointMatrix rounded = inverse.array().round();
  const bool integers = (inverse - rounded).cwiseAbs().maxCoeff() < 1e-12;
  if (integers && std::abs(std::abs(rounded.determinant()) - 1) < 1e-9) return rounded;
  return JointMatrix::Identity(arm.nominal.joints, arm.nominal.joints);
}

JointMatrix WeightOfSamples(const Arm& arm, const std::vector<JointVector>& samples) {
  JointMatrix weight(arm.nominal.joints, arm.nominal.joints);
  for (int joint = 0; joint < arm.nominal.joints; ++joint)
    weight.row(joint) = NarrowestRow(arm, joint, samples);
  return weight;
}

}  // namespace truepose
