#include "core/compensation/table_error.h"

#include "compensation/correct_by_table.h"
#include "compensation/exact.h"

namespace truepose {
namespace {

using compensation::Arm;
using compensation::Correction;
using compensation::Outcome;
using compensation::PoseError;
using compensation::Table;

PoseError Between(const Pose& desired, const Pose& reached) {
  const compensation::Twist left = compensation::Remainder(desired, reached);
  return {left.head<3>().norm(), left.tail<3>().norm()};
}

TablePoint OfMeasuring(const Table& table, const Arm& arm, const double* q) {
  const compensation::Tip tip =
      compensation::TipByTable(table, q, Pose{}, Eigen::Vector3d::UnitZ());
  if (tip.outcome != Outcome::kOk) return {tip.outcome, {}};
  return {Outcome::kOk, Between(compensation::IdentifiedFlange(arm, q), tip.X_BT)};
}

// Against exact correction, where six coordinates can't be met. Also against joints that exact
// correction itself refuses: what the table calls ok is to be held to something.
TablePoint OfFewJoints(const Arm& arm, const double* q, const Correction& corrected) {
  const Correction exact = compensation::CorrectJoints(arm, q, {});
  if (exact.outcome == Outcome::kInvalidArgument) return {exact.outcome, {}};
  return {Outcome::kOk, Between(compensation::IdentifiedFlange(arm, exact.q.data()),
                                compensation::IdentifiedFlange(arm, corrected.q.data()))};
}

}  // namespace

TablePoint TableErrorAt(const Table& table, const Arm& arm, const double* q) {
  if (arm.measuring) return OfMeasuring(table, arm, q);
  const Correction corrected = compensation::CorrectByTable(table, q);
  if (corrected.outcome != Outcome::kOk) return {corrected.outcome, {}};
  if (arm.nominal.joints < 6) return OfFewJoints(arm, q, corrected);
  return {Outcome::kOk, Between(compensation::NominalFlange(arm, q),
                                compensation::IdentifiedFlange(arm, corrected.q.data()))};
}

TableDomain DomainOfTable(const Table& table) {
  const int n = table.header.joints;
  JointMatrix weight(n, n);
  TableDomain domain{TableAxes(table.arm, JointMatrix::Identity(n, n)), {}, {}};
  for (int k = 0; k < n; ++k) {
    const compensation::TableAxis& axis = table.axis[static_cast<size_t>(k)];
    for (int j = 0; j < n; ++j) weight(k, j) = axis.weight[static_cast<size_t>(j)];
    domain.range.push_back({axis.lower, axis.upper});
    domain.margin.push_back(axis.margin);
  }
  domain.axes = TableAxes(table.arm, weight);
  return domain;
}

}  // namespace truepose
