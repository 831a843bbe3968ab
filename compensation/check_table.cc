#include "compensation/check_table.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace truepose::compensation {
namespace {

using Square =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxJoints, kMaxJoints>;

constexpr std::size_t kMostFloats = std::size_t{1} << 40;
constexpr double kLargestWeight = 64;
constexpr double kNotARotation = 1e-9;   // a product of doubles is within 1e-15
constexpr double kNotInvertible = 1e-9;  // smallest pivot over the largest; a real map has about 1

TableReport Invalid(const char* field, int index, double found, const char* expected) {
  if (index < 0) {
    return Refused(TableFault::kInvalidField, "%s: found %g, expected %s", field, found, expected);
  }
  return Refused(TableFault::kInvalidField, "%s %d: found %g, expected %s", field, index + 1, found,
                 expected);
}

bool IsNotNegative(double value) { return std::isfinite(value) && value >= 0; }

TableReport CheckErrors(const TableHeader& header) {
  const PoseError errors[] = {header.tolerance, header.worst, header.percentile_95,
                              header.estimated_worst};
  for (const PoseError& error : errors) {
    if (!IsNotNegative(error.position_m) || !IsNotNegative(error.rotation_rad)) {
      return Invalid("error", static_cast<int>(&error - errors),
                     std::min(error.position_m, error.rotation_rad), "0 or more, finite");
    }
  }
  return {};
}

TableReport CheckHeader(const TableHeader& header) {
  if (header.schema != kTableSchema) return Invalid("schema", -1, header.schema, "1");
  if (header.joints < 1 || header.joints > kMaxJoints)
    return Invalid("joints", -1, header.joints, "1 to 12");
  const Text* names[] = {&header.robot, &header.serial, &header.calibration};
  for (int i = 0; i < 3; ++i) {
    if (!names[i]->valid()) return Invalid("name", i, NAN, "at most 184 bytes, none of them zero");
  }
  if (!IsNotNegative(header.predicted_accuracy_95_m))
    return Invalid("predicted_accuracy_95_m", -1, header.predicted_accuracy_95_m, "0 or more");
  if (!(header.near_singular_share >= 0 && header.near_singular_share <= 1))
    return Invalid("near_singular_share", -1, header.near_singular_share, "0 to 1");
  if (!IsNotNegative(header.smallest_singular_value))
    return Invalid("smallest_singular_value", -1, header.smallest_singular_value, "0 or more");
  if (!(header.characteristic_length_m > 0) || !std::isfinite(header.characteristic_length_m))
    return Invalid("characteristic_length_m", -1, header.characteristic_length_m, "above 0");
  return CheckErrors(header);
}

bool IsPose(const Pose& pose) {
  const double off = (pose.R * pose.R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().sum();
  return off < kNotARotation && pose.R.determinant() > 0 && pose.p.allFinite();
}

TableReport CheckChain(const char* name, const JointChain& chain, int joints) {
  if (chain.joints != joints) return Invalid(name, -1, chain.joints, "as many joints as the table");
  for (int i = 0; i <= joints; ++i) {
    if (!IsPose(chain.constant[i]))
      return Invalid(name, i, NAN, "a rotation and a finite position");
  }
  return {};
}

bool IsInvertible(const Square& matrix) {
  if (!matrix.allFinite()) return false;
  Eigen::FullPivLU<Square> lu(matrix);
  return lu.setThreshold(kNotInvertible).isInvertible();
}

bool IsFinite(const HarmonicEffect& effect) {
  const double values[] = {effect.gain,    effect.cosine[0], effect.cosine[1],
                           effect.sine[0], effect.sine[1],   effect.compliance};
  return std::all_of(std::begin(values), std::end(values),
                     [](double value) { return std::isfinite(value); });
}

TableReport CheckJoints(const Arm& arm, int joints) {
  if (!IsInvertible(arm.joint_scale.topLeftCorner(joints, joints)))
    return Invalid("joint_scale", -1, NAN, "an invertible matrix");
  if (!arm.joint_offset.head(joints).allFinite())
    return Invalid("joint_offset", -1, NAN, "finite numbers");
  for (int i = 0; i < joints; ++i) {
    if (!(arm.limits[i].lower <= arm.limits[i].upper))
      return Invalid("limits", i, arm.limits[i].lower, "at most the upper one");
    if (!IsFinite(arm.effects[i])) return Invalid("effects", i, NAN, "finite numbers");
  }
  return {};
}

TableReport CheckMasses(const Arm& arm, int joints) {
  if (arm.masses < 0 || arm.masses > kMaxMasses)
    return Invalid("masses", -1, arm.masses, "0 to 16");
  for (int i = 0; i < arm.masses; ++i) {
    const PointMass& mass = arm.mass[i];
    if (mass.joint < 0 || mass.joint >= joints)
      return Invalid("mass joint", i, mass.joint, "a joint, from 0");
    if (!IsNotNegative(mass.mass_kg) || !mass.centre_B.allFinite())
      return Invalid("mass", i, mass.mass_kg, "0 or more, finite, at a finite place");
  }
  return {};
}

TableReport CheckArm(const Arm& arm, int joints) {
  if (TableReport r = CheckChain("nominal constant", arm.nominal, joints); !r.ok()) return r;
  if (TableReport r = CheckChain("identified constant", arm.identified, joints); !r.ok()) return r;
  if (arm.nominal.prismatic != arm.identified.prismatic)
    return Invalid("identified prismatic", -1, NAN, "those of the nominal chain");
  if (TableReport r = CheckJoints(arm, joints); !r.ok()) return r;
  return CheckMasses(arm, joints);
}

TableReport CheckAxis(const TableAxis& axis, int index, int joints) {
  for (int j = 0; j < joints; ++j) {
    const double weight = axis.weight[j];
    if (!(std::abs(weight) <= kLargestWeight) || weight != std::round(weight))
      return Invalid("weight of axis", index, weight, "an integer of at most 64");
  }
  if (!std::isfinite(axis.lower) || !std::isfinite(axis.upper) || axis.lower > axis.upper)
    return Invalid("lower of axis", index, axis.lower, "finite, at most upper");
  if (!IsNotNegative(axis.margin))
    return Invalid("margin of axis", index, axis.margin, "0 or more");
  if (axis.nodes < 1) return Invalid("nodes of axis", index, axis.nodes, "1 or more");
  const double width = axis.upper - axis.lower + 2 * axis.margin;
  if (!std::isfinite(width) || (axis.nodes > 1 && !std::isnormal((axis.nodes - 1) / width)))
    return Invalid("range of axis", index, width, "above 0 and finite");
  return {};
}

TableReport CheckAxes(const std::array<TableAxis, kMaxJoints>& axes, int joints) {
  Square weights(joints, joints);
  for (int i = 0; i < joints; ++i) {
    if (TableReport r = CheckAxis(axes[i], i, joints); !r.ok()) return r;
    for (int j = 0; j < joints; ++j) weights(i, j) = axes[i].weight[j];
  }
  const double determinant = weights.partialPivLu().determinant();
  if (!(std::abs(std::abs(determinant) - 1) < 1e-6))
    return Invalid("determinant of the axes' weights", -1, determinant, "1 or -1");
  return {};
}

}  // namespace

std::size_t FloatsOfGrid(const std::array<TableAxis, kMaxJoints>& axes, int joints) noexcept {
  std::size_t floats = kNodeFloats;
  for (int i = 0; i < joints; ++i) {
    if (axes[i].nodes < 1 || static_cast<std::size_t>(axes[i].nodes) > kMostFloats / floats)
      return 0;
    floats *= axes[i].nodes;
  }
  return floats;
}

TableReport CheckTable(const TableHeader& header, const Arm& arm,
                       const std::array<TableAxis, kMaxJoints>& axes,
                       std::span<const float> nodes) noexcept {
  if (TableReport r = CheckHeader(header); !r.ok()) return r;
  if (TableReport r = CheckArm(arm, header.joints); !r.ok()) return r;
  if (TableReport r = CheckAxes(axes, header.joints); !r.ok()) return r;
  if (nodes.size() != FloatsOfGrid(axes, header.joints))
    return Invalid("nodes", -1, static_cast<double>(nodes.size()), "six for each node of the axes");
  const auto bad =
      std::find_if(nodes.begin(), nodes.end(), [](float x) { return !std::isfinite(x); });
  if (bad != nodes.end())
    return Invalid("node", static_cast<int>((bad - nodes.begin()) / kNodeFloats), *bad, "finite");
  return {};
}

}  // namespace truepose::compensation
