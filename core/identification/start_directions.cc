#include "core/identification/start_directions.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace truepose {
namespace {

constexpr size_t kMostNormals = 4;
constexpr size_t kFewestRows = 3;  // of a plane fit

// Rows with one normal, signs of the normals made equal.
using Group = std::vector<PlaneRow>;

PlaneRow Reversed(PlaneRow row) {
  row.normal_M = -row.normal_M;
  row.value_m = -row.value_m;
  return row;
}

void AddTo(const PlaneRow& row, std::vector<Group>* groups) {
  for (Group& group : *groups) {
    const double c = group[0].normal_M.dot(row.normal_M);
    if (std::abs(c) < 1 - 1e-6) continue;
    return group.push_back(c > 0 ? row : Reversed(row));
  }
  groups->push_back({row});
}

std::vector<Group> GroupsOf(const std::vector<PlaneRow>& rows) {
  std::vector<Group> groups;
  for (const PlaneRow& row : rows) AddTo(row, &groups);
  std::erase_if(groups, [](const Group& group) { return group.size() < kFewestRows; });
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Group& a, const Group& b) { return a.size() > b.size(); });
  if (groups.size() > kMostNormals) groups.resize(kMostNormals);
  return groups;
}

// The points and heights of a group, centred, as moments in principal axes, least spread first.
struct Moments {
  Eigen::Matrix3d axes;
  Eigen::Vector3d spread;      // sums of x^2
  Eigen::Vector3d covariance;  // sums of x m
};

Moments MomentsOf(const Group& group) {
  const Eigen::Index k = static_cast<Eigen::Index>(group.size());
  Eigen::MatrixX3d x(k, 3);
  Eigen::VectorXd m(k);
  for (Eigen::Index i = 0; i < k; ++i) {
    x.row(i) = group[static_cast<size_t>(i)].x_B.transpose();
    m(i) = group[static_cast<size_t>(i)].value_m;
  }
  x.rowwise() -= x.colwise().mean().eval();
  m.array() -= m.mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(x.transpose() * x);
  return {eigen.eigenvectors(), eigen.eigenvalues(),
          eigen.eigenvectors().transpose() * (x.transpose() * m)};
}

// (spread + mu)^-1 covariance; mu = 0 is the linear fit.
Eigen::Vector3d FitAt(const Moments& moments, double mu) {
  return moments.covariance.cwiseQuotient(
      (moments.spread.array() + mu).max(1e-12 * moments.spread(2)).matrix());
}

// The fit of length 1: |r| falls with mu, from any length where mu takes all of the least spread.
Eigen::Vector3d UnitFit(const Moments& moments) {
  double low = -moments.spread(0), high = moments.covariance.norm() + moments.spread(2);
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (FitAt(moments, middle).norm() > 1 ? low : high) = middle;
  }
  return FitAt(moments, high).normalized();
}

// r = R_MB^T n. Measured values that vary much with x give it by a linear fit, sign included. A
// guessed target blurs x by more than the steps of a block, and then the fit of length 1 is needed;
// its sign along the direction of least spread is not sure, and arbitrary at a single height.
std::vector<Eigen::Vector3d> NormalsInB(const Group& group) {
  const Moments moments = MomentsOf(group);
  const Eigen::Vector3d linear = FitAt(moments, 0);
  if (linear.norm() > 0.8) return {moments.axes * linear.normalized()};
  Eigen::Vector3d r = UnitFit(moments);
  if (moments.covariance.norm() < 1e-9 * moments.spread(2)) r = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d other(-r.x(), r.y(), r.z());
  return {moments.axes * r, moments.axes * other};
}

}  // namespace

std::vector<std::vector<Direction>> DirectionChoices(const std::vector<PlaneRow>& rows) {
  std::vector<std::vector<Direction>> choices(1);
  for (const Group& group : GroupsOf(rows)) {
    std::vector<std::vector<Direction>> longer;
    for (const Eigen::Vector3d& r : NormalsInB(group)) {
      for (std::vector<Direction> choice : choices) {
        choice.push_back({group[0].normal_M, r});
        longer.push_back(std::move(choice));
      }
    }
    choices = std::move(longer);
  }
  return choices;
}

}  // namespace truepose
