#include "core/identification/start_trilateration.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace truepose {
namespace {

// Which columns each beam has behind those of the point: s, then c of those that have one.
std::vector<int> BeamsOf(const Distances& distances) {
  std::vector<int> beams = distances.beam;
  std::sort(beams.begin(), beams.end());
  beams.erase(std::unique(beams.begin(), beams.end()), beams.end());
  return beams;
}

// Of the system in principal axes about the mean, least spread first.
struct Centred {
  Eigen::Vector3d mean;
  Eigen::Matrix3d axes;
  Eigen::Matrix3Xd x;
};

Centred CentredOf(const std::vector<Eigen::Vector3d>& points) {
  Centred centred;
  centred.x.resize(3, static_cast<Eigen::Index>(points.size()));
  for (size_t k = 0; k < points.size(); ++k)
    centred.x.col(static_cast<Eigen::Index>(k)) = points[k];
  centred.mean = centred.x.rowwise().mean();
  centred.x.colwise() -= centred.mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(centred.x * centred.x.transpose());
  centred.axes = spread.eigenvectors();
  centred.x = centred.axes.transpose() * centred.x;
  return centred;
}

// Rows 2 x_k, -1 for s of its beam, -2 d_k for c of its beam.
Eigen::MatrixXd Rows(const Distances& distances, const Centred& centred,
                     const std::vector<int>& beams) {
  const Eigen::Index k = centred.x.cols(), b = static_cast<Eigen::Index>(beams.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(k, 3 + 2 * b);
  A.leftCols<3>() = 2 * centred.x.transpose();
  for (Eigen::Index i = 0; i < k; ++i) {
    const int beam = distances.beam[static_cast<size_t>(i)];
    const Eigen::Index column = std::find(beams.begin(), beams.end(), beam) - beams.begin();
    A(i, 3 + column) = -1;
    if (beam >= 0) A(i, 3 + b + column) = -2 * distances.d[static_cast<size_t>(i)];
  }
  return A;
}

// |a|^2 = s + c^2 as the first beam has it.
double SquaredLength(const Eigen::VectorXd& solution, Eigen::Index first, Eigen::Index beams) {
  return solution(first) + std::pow(solution(first + beams), 2);
}

}  // namespace

int UnknownsOf(const Distances& distances) {
  const std::vector<int> beams = BeamsOf(distances);
  const auto constants = std::count_if(beams.begin(), beams.end(), [](int b) { return b >= 0; });
  return 3 + static_cast<int>(beams.size()) + static_cast<int>(constants);
}

std::vector<Eigen::Vector3d> Trilaterate(const Distances& distances) {
  const Centred centred = CentredOf(distances.x);
  const std::vector<int> beams = BeamsOf(distances);
  const Eigen::Index b = static_cast<Eigen::Index>(beams.size());
  const Eigen::MatrixXd A = Rows(distances, centred, beams);
  const Eigen::VectorXd d = Eigen::Map<const Eigen::VectorXd>(distances.d.data(), centred.x.cols());
  const Eigen::VectorXd rhs = centred.x.colwise().squaredNorm().transpose() - d.cwiseAbs2();
  const Eigen::Vector3d linear = A.completeOrthogonalDecomposition().solve(rhs).head<3>();
  const Eigen::VectorXd flat = A.rightCols(2 + 2 * b).completeOrthogonalDecomposition().solve(rhs);
  const double height =
      std::sqrt(std::max(0.0, SquaredLength(flat, 2, b) - flat.head<2>().squaredNorm()));
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& a : {linear, Eigen::Vector3d(height, flat(0), flat(1)),
                                   Eigen::Vector3d(-height, flat(0), flat(1))})
    points.push_back(centred.mean + centred.axes * a);
  return points;
}

}  // namespace truepose
