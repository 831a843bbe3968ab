#include "core/identification/start_partial.h"

#include <Eigen/Dense>
#include <algorithm>

#include "core/identification/start_directions.h"
#include "core/identification/start_trilateration.h"

namespace truepose {
namespace {

using Readings = std::vector<NominalReading>;
using Points = std::vector<Eigen::Vector3d>;

// All that is known of the base at one target position.
struct Evidence {
  Points point_M, point_B;
  std::vector<Direction> directions;
  std::vector<PlaneRow> rows;
};

// The coordinates or the plane of a reading; none of other kinds.
std::vector<PlaneRow> RowsOf(const Reading& reading, const Eigen::Vector3d& x_B) {
  if (reading.kind == ObservationKind::kPlane)
    return {{reading.normal_M, reading.normal_M.dot(reading.X_MT.p), x_B}};
  std::vector<PlaneRow> rows;
  if (reading.kind != ObservationKind::kCoordinates) return rows;
  for (int axis = 0; axis < 3; ++axis) {
    if (reading.coordinates[axis])
      rows.push_back({Eigen::Vector3d::Unit(axis), reading.X_MT.p(axis), x_B});
  }
  return rows;
}

struct Anchor {
  Eigen::Vector3d M;
  Distances from_B;
};

// @param in_B the point whose distance a reading has, or what stands for it.
void Add(const Reading& reading, const Eigen::Vector3d& in_B, Distances* distances) {
  distances->x.push_back(in_B);
  distances->d.push_back(reading.distance_m);
  distances->beam.push_back(reading.offset);
}

std::vector<Anchor> AnchorsOf(const Readings& readings, const Eigen::Vector3d& p_FT) {
  std::vector<Anchor> anchors;
  for (const NominalReading& r : readings) {
    if (r.reading->kind != ObservationKind::kDistance) continue;
    size_t k = 0;
    while (k < anchors.size() && anchors[k].M != r.reading->anchor_M) ++k;
    if (k == anchors.size()) anchors.push_back({r.reading->anchor_M, {}});
    Add(*r.reading, r.X_BF * p_FT, &anchors[k].from_B);
  }
  return anchors;
}

Eigen::Matrix3d Rotation(const Evidence& evidence) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d mean_M = Eigen::Vector3d::Zero(), mean_B = Eigen::Vector3d::Zero();
  const size_t k = evidence.point_M.size();
  for (size_t i = 0; i < k; ++i) {
    mean_M += evidence.point_M[i] / static_cast<double>(k);
    mean_B += evidence.point_B[i] / static_cast<double>(k);
  }
  for (size_t i = 0; i < k; ++i)
    sum += (evidence.point_M[i] - mean_M) * (evidence.point_B[i] - mean_B).transpose();
  for (const Direction& direction : evidence.directions)
    sum += direction.M * direction.B.transpose();
  return NearestRotation(sum);
}

// Positions meet points in all axes, planes along their normals; the least-norm solution where
// they leave some free.
Pose BaseFrom(const Evidence& evidence) {
  const Eigen::Matrix3d R = Rotation(evidence);
  const Eigen::Index points = static_cast<Eigen::Index>(evidence.point_M.size());
  const Eigen::Index rows = static_cast<Eigen::Index>(evidence.rows.size());
  Eigen::MatrixXd A(3 * points + rows, 3);
  Eigen::VectorXd b(3 * points + rows);
  for (Eigen::Index i = 0; i < points; ++i) {
    const size_t k = static_cast<size_t>(i);
    A.middleRows<3>(3 * i).setIdentity();
    b.segment<3>(3 * i) = evidence.point_M[k] - R * evidence.point_B[k];
  }
  for (Eigen::Index i = 0; i < rows; ++i) {
    const PlaneRow& row = evidence.rows[static_cast<size_t>(i)];
    A.row(3 * points + i) = row.normal_M.transpose();
    b(3 * points + i) = row.value_m - row.normal_M.dot(R * row.x_B);
  }
  if (b.size() == 0) return {R, Eigen::Vector3d::Zero()};
  return {R, A.completeOrthogonalDecomposition().solve(b)};
}

// With up to three anchors each may be mirrored on its own, more tell each other's side.
constexpr size_t kMostMirrored = 3;

// Choices of points in B, one an anchor.
std::vector<Points> AnchorChoices(const std::vector<Anchor>& anchors) {
  std::vector<Points> guesses;
  for (const Anchor& anchor : anchors) guesses.push_back(Trilaterate(anchor.from_B));
  std::vector<Points> choices(1);
  for (const Points& points : guesses) choices[0].push_back(points[0]);
  if (anchors.size() > kMostMirrored) return choices;
  for (unsigned sides = 0; sides < 1u << anchors.size() && !anchors.empty(); ++sides) {
    Points choice;
    for (size_t i = 0; i < anchors.size(); ++i) choice.push_back(guesses[i][1 + (sides >> i & 1)]);
    choices.push_back(std::move(choice));
  }
  return choices;
}

Evidence PointsAndRows(const Readings& readings, const Eigen::Vector3d& p_FT) {
  Evidence evidence;
  for (const NominalReading& r : readings) {
    const Eigen::Vector3d x_B = r.X_BF * p_FT;
    if (ShowsPoint(*r.reading)) {
      evidence.point_M.push_back(r.reading->X_MT.p);
      evidence.point_B.push_back(x_B);
    }
    for (const PlaneRow& row : RowsOf(*r.reading, x_B)) evidence.rows.push_back(row);
  }
  return evidence;
}

// p_MB from the distances alone, at one rotation: |p_MB - (anchor - R_MB x)| = d.
void AddTrilateratedBases(const Readings& readings, const Eigen::Vector3d& p_FT,
                          std::vector<Pose>* bases) {
  for (const Eigen::Matrix3d& R : CubeRotations()) {
    Distances distances;
    for (const NominalReading& r : readings) {
      if (r.reading->kind == ObservationKind::kDistance)
        Add(*r.reading, r.reading->anchor_M - R * (r.X_BF * p_FT), &distances);
    }
    bases->push_back({R, Trilaterate(distances)[0]});
  }
}

bool SeenTooRarely(const Anchor& anchor) {
  return static_cast<int>(anchor.from_B.d.size()) < UnknownsOf(anchor.from_B);
}

}  // namespace

std::vector<Pose> BasesFromToolPosition(const Readings& readings, const Eigen::Vector3d& p_FT) {
  const Evidence seen = PointsAndRows(readings, p_FT);
  std::vector<Anchor> anchors = AnchorsOf(readings, p_FT);
  const size_t all_anchors = anchors.size();
  std::erase_if(anchors, SeenTooRarely);
  std::vector<Pose> bases;
  for (const Points& points_B : AnchorChoices(anchors)) {
    for (const std::vector<Direction>& directions : DirectionChoices(seen.rows)) {
      Evidence evidence = seen;
      evidence.directions = directions;
      for (const Anchor& anchor : anchors) evidence.point_M.push_back(anchor.M);
      evidence.point_B.insert(evidence.point_B.end(), points_B.begin(), points_B.end());
      bases.push_back(BaseFrom(evidence));
    }
  }
  if (anchors.size() < std::min<size_t>(all_anchors, 3))
    AddTrilateratedBases(readings, p_FT, &bases);
  return bases;
}

std::vector<Eigen::Vector3d> ToolPositionsFromBase(const Readings& readings, const Pose& X_MB) {
  std::vector<Eigen::Vector3d> positions;
  Distances distances;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const auto add_row = [&](const Pose& X_MF, const Eigen::Vector3d& n_M, double value) {
    const Eigen::Vector3d n_F = X_MF.R.transpose() * n_M;
    normal += n_F * n_F.transpose();
    right += n_F * (value - n_M.dot(X_MF.p));
  };
  for (const NominalReading& r : readings) {
    const Pose X_MF = X_MB * r.X_BF;
    for (const PlaneRow& row : RowsOf(*r.reading, X_MF.p)) add_row(X_MF, row.normal_M, row.value_m);
    for (int axis = 0; axis < 3 && ShowsPoint(*r.reading); ++axis)
      add_row(X_MF, Eigen::Vector3d::Unit(axis), r.reading->X_MT.p(axis));
    if (r.reading->kind == ObservationKind::kDistance)
      Add(*r.reading, Inverse(X_MF) * r.reading->anchor_M, &distances);
  }
  if (!normal.isZero(0)) positions.push_back(normal.completeOrthogonalDecomposition().solve(right));
  if (distances.d.empty()) return positions;
  for (const Eigen::Vector3d& p_FT : Trilaterate(distances)) positions.push_back(p_FT);
  return positions;
}

}  // namespace truepose
