#include "core/measurement/reading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace truepose {
namespace {

void PositionResidual(const Reading& reading, const Pose& X_MT, Residual* r, ResidualByTwist* D,
                      int rows) {
  r->resize(rows);
  r->head<3>() = reading.X_MT.p - X_MT.p;
  if (D == nullptr) return;
  D->setZero(rows, 6);
  D->topLeftCorner<3, 3>() = -Eigen::Matrix3d::Identity();
}

void EvaluatePoint(const Reading& reading, const Pose& X_MT, Residual* r, ResidualByTwist* D) {
  PositionResidual(reading, X_MT, r, D, 3);
}

// R_measured R^T Exp(-w): d Log = -J_r^-1(Log) w.
void EvaluatePose(const Reading& reading, const Pose& X_MT, Residual* r, ResidualByTwist* D) {
  PositionResidual(reading, X_MT, r, D, 6);
  const Eigen::Vector3d rotation = LogRotation<double>(reading.X_MT.R * X_MT.R.transpose());
  r->tail<3>() = rotation;
  if (D != nullptr) D->bottomRightCorner<3, 3>() = -RightJacobianInverse(rotation);
}

// Two unit vectors perpendicular to a and to each other, as rows.
Eigen::Matrix<double, 2, 3> PerpendicularRows(const Eigen::Vector3d& a) {
  int smallest = 0;
  a.cwiseAbs().minCoeff(&smallest);
  const Eigen::Vector3d e1 = a.cross(Eigen::Vector3d::Unit(smallest)).normalized();
  Eigen::Matrix<double, 2, 3> rows;
  rows << e1.transpose(), a.cross(e1).transpose();
  return rows;
}

// angle / sin(angle) as a function of c = cos(angle), and its derivative by c; by series where they
// are 0 / 0.
struct AngleOverSine {
  double value, derivative;
};

AngleOverSine AngleOverSineOf(double c, double s) {
  if (c > 0 && s < 1e-4) return {1 + s * s / 6, -1.0 / 3 - 2 * s * s / 15};
  const double value = std::atan2(s, c) / std::max(s, 1e-12);
  return {value, (c * value - 1) / std::max(s * s, 1e-24)};
}

// Rotation vector f(c) (a x m) from predicted axis a to measured axis m, with c = a . m and da = w
// x a.
void EvaluatePointAxis(const Reading& reading, const Pose& X_MT, Residual* r, ResidualByTwist* D) {
  PositionResidual(reading, X_MT, r, D, 5);
  const Eigen::Vector3d m = reading.axis_M, a = X_MT.R.col(2), cross = a.cross(m);
  const auto [f, df] = AngleOverSineOf(a.dot(m), cross.norm());
  const Eigen::Matrix<double, 2, 3> rows = PerpendicularRows(m);
  r->tail<2>() = rows * (f * cross);
  if (D == nullptr) return;
  // da = -Hat(a) w; d cross = -Hat(m) da; dc = m . da
  const Eigen::Matrix3d da = -Hat<double>(a);
  const Eigen::Matrix3d derivative = -f * Hat<double>(m) * da + df * cross * (m.transpose() * da);
  D->bottomRightCorner<2, 3>() = rows * derivative;
}

// The measured ones of x, y, z.
void EvaluateCoordinates(const Reading& reading, const Pose& X_MT, Residual* r,
                         ResidualByTwist* D) {
  const int rows = PositionRowsOf(reading);
  r->resize(rows);
  if (D != nullptr) D->setZero(rows, 6);
  for (int axis = 0, row = 0; axis < 3; ++axis) {
    if (!reading.coordinates[axis]) continue;
    (*r)(row) = reading.X_MT.p(axis) - X_MT.p(axis);
    if (D != nullptr) (*D)(row, axis) = -1;
    ++row;
  }
}

// d = |p - a|, dd = u . v. At the anchor itself no direction is better than another: the derivative
// is taken as zero there.
void EvaluateDistance(const Reading& reading, const Pose& X_MT, Residual* r, ResidualByTwist* D) {
  const Eigen::Vector3d line = X_MT.p - reading.anchor_M;
  const double length = line.norm();
  r->resize(1);
  (*r)(0) = reading.distance_m - length;
  if (D == nullptr) return;
  D->setZero(1, 6);
  if (length > 0) D->leftCols<3>() = -line.transpose() / length;
}

// Where in the plane the tool touches is not seen.
void EvaluatePlane(const Reading& reading, const Pose& X_MT, Residual* r, ResidualByTwist* D) {
  r->resize(1);
  (*r)(0) = reading.normal_M.dot(reading.X_MT.p - X_MT.p);
  if (D == nullptr) return;
  D->setZero(1, 6);
  D->leftCols<3>() = -reading.normal_M.transpose();
}

constexpr std::array<MeasurementKind, 6> kKinds = {{
    {ObservationKind::kPose, "pose", 3, 3, EvaluatePose},
    {ObservationKind::kPoint, "point", 3, 0, EvaluatePoint},
    {ObservationKind::kPointAxis, "point_axis", 3, 2, EvaluatePointAxis},
    {ObservationKind::kCoordinates, "coordinates", 3, 0, EvaluateCoordinates},
    {ObservationKind::kDistance, "distance", 1, 0, EvaluateDistance},
    {ObservationKind::kPlane, "plane", 1, 0, EvaluatePlane},
}};

}  // namespace

const MeasurementKind& KindOf(ObservationKind kind) { return kKinds[static_cast<size_t>(kind)]; }

Units UnitsOfRows(const std::vector<int>& rows) {
  Units units;
  std::map<int, int> known;
  for (const int row : rows) {
    const int unit = row < 0 ? units.count : known.emplace(row, units.count).first->second;
    units.of.push_back(unit);
    units.count = std::max(units.count, unit + 1);
  }
  return units;
}

int PositionRowsOf(const Reading& reading) {
  if (reading.kind != ObservationKind::kCoordinates) return KindOf(reading.kind).position_rows;
  return static_cast<int>(std::count(reading.coordinates.begin(), reading.coordinates.end(), true));
}

int RotationRowsOf(const Reading& reading) { return KindOf(reading.kind).rotation_rows; }

int RowsOf(const Reading& reading) { return PositionRowsOf(reading) + RotationRowsOf(reading); }

}  // namespace truepose
