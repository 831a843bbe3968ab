#include "core/identification/start_candidates.h"

#include <Eigen/Dense>

namespace truepose {
namespace {

using Readings = std::vector<NominalReading>;

bool AllPoses(const Readings& readings) {
  for (const NominalReading& r : readings) {
    if (r.reading->kind != ObservationKind::kPose) return false;
  }
  return true;
}

// A rotation whose z axis is `axis`; its roll is arbitrary.
Eigen::Matrix3d RotationWithZ(const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis).toRotationMatrix();
}

Eigen::Matrix3d AverageBaseRotation(const Readings& readings, const Eigen::Matrix3d& R_FT) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const NominalReading& r : readings) sum += r.reading->X_MT.R * (r.X_BF.R * R_FT).transpose();
  return NearestRotation(sum);
}

// p_MT = p_MB + R_MB R_BF p_FT (+ R_MB p_BF) is linear in both positions; the least-norm solution
// where they overlap.
void SolvePositions(const Readings& readings, FramePair* pair) {
  const Eigen::Index k = static_cast<Eigen::Index>(readings.size());
  Eigen::MatrixXd A(3 * k, 6);
  Eigen::VectorXd b(3 * k);
  for (Eigen::Index i = 0; i < k; ++i) {
    const NominalReading& r = readings[static_cast<size_t>(i)];
    A.block<3, 3>(3 * i, 0) = Eigen::Matrix3d::Identity();
    A.block<3, 3>(3 * i, 3) = pair->X_MB.R * r.X_BF.R;
    b.segment<3>(3 * i) = r.reading->X_MT.p - pair->X_MB.R * r.X_BF.p;
  }
  const Eigen::VectorXd x = A.completeOrthogonalDecomposition().solve(b);
  pair->X_MB.p = x.head<3>();
  pair->X_FT.p = x.tail<3>();
}

// Each step can only lower sum |R_MT - R_MB R_BF R_FT|^2; ten bring it near its minimum, least
// squares does the rest.
FramePair FromToolRotation(const Readings& readings, Eigen::Matrix3d R_FT) {
  FramePair pair;
  for (int i = 0; i < 10; ++i) {
    pair.X_MB.R = AverageBaseRotation(readings, R_FT);
    R_FT = AverageToolRotation(readings, pair.X_MB.R);
  }
  pair.X_FT.R = R_FT;
  SolvePositions(readings, &pair);
  return pair;
}

FramePair FromToolPosition(const Readings& readings, const Eigen::Vector3d& p_FT) {
  Eigen::Matrix3Xd measured(3, readings.size()), nominal(3, readings.size());
  for (size_t i = 0; i < readings.size(); ++i) {
    measured.col(static_cast<Eigen::Index>(i)) = readings[i].reading->X_MT.p;
    nominal.col(static_cast<Eigen::Index>(i)) = readings[i].X_BF * p_FT;
  }
  FramePair pair;
  pair.X_MB = AlignPoints(measured, nominal);
  pair.X_FT = {AverageToolRotation(readings, pair.X_MB.R), p_FT};
  return pair;
}

}  // namespace

bool ShowsPoint(const Reading& reading) {
  return reading.kind == ObservationKind::kPose || reading.kind == ObservationKind::kPoint ||
         reading.kind == ObservationKind::kPointAxis;
}

Eigen::Matrix3d AverageToolRotation(const Readings& readings, const Eigen::Matrix3d& R_MB) {
  Eigen::Matrix3d rotations = Eigen::Matrix3d::Zero();
  Eigen::Vector3d axes = Eigen::Vector3d::Zero();
  for (const NominalReading& r : readings) {
    const Eigen::Matrix3d R_FM = (R_MB * r.X_BF.R).transpose();
    if (r.reading->kind == ObservationKind::kPose) rotations += R_FM * r.reading->X_MT.R;
    if (r.reading->kind == ObservationKind::kPointAxis) axes += R_FM * r.reading->axis_M;
  }
  if (rotations.norm() > 0) return NearestRotation(rotations);
  if (axes.norm() > 1e-9) return RotationWithZ(axes.normalized());
  return Eigen::Matrix3d::Identity();
}

std::vector<Eigen::Matrix3d> CubeRotations() {
  std::vector<Eigen::Matrix3d> rotations;
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 6; ++y) {
      if (x % 3 == y % 3) continue;
      const Eigen::Vector3d a = Eigen::Vector3d::Unit(x % 3) * (x < 3 ? 1 : -1);
      const Eigen::Vector3d b = Eigen::Vector3d::Unit(y % 3) * (y < 3 ? 1 : -1);
      Eigen::Matrix3d R;
      R << a, b, a.cross(b);
      rotations.push_back(R);
    }
  }
  return rotations;
}

std::vector<Eigen::Vector3d> ToolPositions() {
  std::vector<Eigen::Vector3d> positions = {Eigen::Vector3d::Zero()};
  for (double length : {0.1, 0.3}) {
    for (int axis = 0; axis < 3; ++axis) {
      positions.push_back(length * Eigen::Vector3d::Unit(axis));
      positions.push_back(-length * Eigen::Vector3d::Unit(axis));
    }
  }
  return positions;
}

std::vector<FramePair> StartCandidates(const Readings& readings, const std::optional<Pose>& X_FT) {
  std::vector<FramePair> pairs;
  if (X_FT.has_value()) {
    pairs.push_back({BaseFromTool(readings, *X_FT), *X_FT});
    pairs.push_back(FromToolPosition(readings, X_FT->p));
  }
  for (const Eigen::Vector3d& p_FT : ToolPositions())
    pairs.push_back(FromToolPosition(readings, p_FT));
  if (!AllPoses(readings)) return pairs;
  for (const Eigen::Matrix3d& R_FT : CubeRotations())
    pairs.push_back(FromToolRotation(readings, R_FT));
  return pairs;
}

Pose BaseFromTool(const Readings& readings, const Pose& X_FT) {
  if (!AllPoses(readings)) return FromToolPosition(readings, X_FT.p).X_MB;
  Pose X_MB{AverageBaseRotation(readings, X_FT.R), Eigen::Vector3d::Zero()};
  for (const NominalReading& r : readings) X_MB.p += r.reading->X_MT.p - X_MB.R * (r.X_BF * X_FT.p);
  X_MB.p /= static_cast<double>(readings.size());
  return X_MB;
}

Pose ToolFromBase(const Readings& readings, const Pose& X_MB) {
  Pose X_FT{AverageToolRotation(readings, X_MB.R), Eigen::Vector3d::Zero()};
  for (const NominalReading& r : readings) X_FT.p += Inverse(X_MB * r.X_BF) * r.reading->X_MT.p;
  X_FT.p /= static_cast<double>(readings.size());
  return X_FT;
}

}  // namespace truepose
