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

// r = R_MB^T n. Measured values that vary with x give it by a linear fit, sign included; values
// that are all the same give |r| = 0 there, and r is the direction of least spread, either way.
std::vector<Eigen::Vector3d> NormalsInB(const Group& group) {
  const Eigen::Index k = static_cast<Eigen::Index>(group.size());
  Eigen::MatrixX3d x(k, 3);
  Eigen::VectorXd m(k);
  for (Eigen::Index i = 0; i < k; ++i) {
    x.row(i) = group[static_cast<size_t>(i)].x_B.transpose();
    m(i) = group[static_cast<size_t>(i)].value_m;
  }
  x.rowwise() -= x.colwise().mean().eval();
  m.array() -= m.mean();
  const Eigen::Vector3d r = x.completeOrthogonalDecomposition().solve(m);
  if (r.norm() > 0.5) return {r.normalized()};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(x.transpose() * x);
  return {spread.eigenvectors().col(0), -spread.eigenvectors().col(0)};
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
