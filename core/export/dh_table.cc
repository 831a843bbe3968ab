#include "core/export/dh_table.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace truepose {
namespace {

// Sine of the angle below which axes are taken as parallel.
constexpr double kParallel = 1e-10;
// m; below it parallel axes are one line.
constexpr double kCoincident = 1e-12;
// A normal may point this far backwards, so that an error of a right angle does not turn it round.
constexpr double kBackwards = -0.1;

struct Line {
  Eigen::Vector3d p, u;
};

// What rounding leaves where a data sheet has 0.
double WithoutNoise(double value) { return std::abs(value) < 1e-15 ? 0 : value; }

Line LineIn(const Pose& X, const Line& line) {
  return {X.R.transpose() * (line.p - X.p), X.R.transpose() * line.u};
}

// Of crossing or skew lines: `normal` is the unit vector across both.
DhRow SkewRow(const Line& next, double sine) {
  Eigen::Vector3d normal(-next.u.y() / sine, next.u.x() / sine, 0);
  const double side = normal.x() < kBackwards ? -1 : 1;
  normal *= side;
  const Eigen::Vector3d across(-next.u.y(), next.u.x(), 0);  // z x u
  return {std::atan2(normal.y(), normal.x()), next.p.cross(next.u).dot(across) / (sine * sine),
          next.p.dot(normal), side * std::atan2(sine, next.u.z())};
}

DhRow ParallelRow(const Line& next) {
  const double alpha = next.u.z() > 0 ? 0 : std::numbers::pi;
  const Eigen::Vector3d foot = next.p - next.u * (next.p.z() / next.u.z());
  const double distance = std::hypot(foot.x(), foot.y());
  if (distance < kCoincident) return {0, 0, 0, alpha};
  const double side = foot.x() < kBackwards * distance ? -1 : 1;
  return {std::atan2(side * foot.y(), side * foot.x()), 0, side * distance, alpha};
}

// From the frame X, whose z is an axis, to the next axis.
DhRow RowTo(const Line& next_B, const Pose& X) {
  const Line next = LineIn(X, next_B);
  const double sine = std::hypot(next.u.x(), next.u.y());
  const DhRow row = sine > kParallel ? SkewRow(next, sine) : ParallelRow(next);
  return {WithoutNoise(row.theta), WithoutNoise(row.d), WithoutNoise(row.a),
          WithoutNoise(row.alpha)};
}

// By the numbers of the row, so that the next row repairs their rounding.
Pose Behind(const Pose& X, const DhRow& row) {
  return X * Forward<double>(ChainFromStandardDh({row}, {JointType::kRevolute}),
                             std::vector<double>{0}.data(), nullptr);
}

std::vector<Line> LinesOf(const Home& home) {
  std::vector<Line> lines(home.axes.size());
  Eigen::Vector3d near = home.X_BF.p;
  for (size_t i = lines.size(); i-- > 0;) {
    const JointAxis& axis = home.axes[i];
    if (axis.type == JointType::kRevolute) near = axis.p + axis.u * axis.u.dot(near - axis.p);
    lines[i] = {near, axis.u};
  }
  return lines;
}

// What is left of F behind the last row, moved into that row as far as its screw about z reaches.
void FinishFlange(const Pose& X_BN, const Pose& X_BF, DhTable* table) {
  const Pose X_NF = Inverse(X_BN) * X_BF;
  table->flange_theta = WithoutNoise(std::atan2(X_NF.R(1, 0), X_NF.R(0, 0)));
  table->flange_d = WithoutNoise(X_NF.p.z());
  DhRow& last = table->rows.back();
  if (last.alpha != 0 && last.alpha != std::numbers::pi) return;
  const double sign = last.alpha == 0 ? 1 : -1;
  last.d += sign * table->flange_d;
  table->flange_d = 0;
  if (last.a != 0) return;
  last.theta += sign * table->flange_theta;
  table->flange_theta = 0;
}

}  // namespace

DhTable DhTableOf(const Home& home) {
  std::vector<Line> lines = LinesOf(home);
  lines.push_back({home.X_BF.p, home.X_BF.R.col(2)});
  DhTable table;
  table.base = RowTo(lines[0], Pose{});
  Pose X = Behind(Pose{}, table.base);
  for (size_t i = 1; i < lines.size(); ++i) {
    table.rows.push_back(RowTo(lines[i], X));
    X = Behind(X, table.rows.back());
  }
  FinishFlange(X, home.X_BF, &table);
  return table;
}

}  // namespace truepose
