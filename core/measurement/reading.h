// What an instrument observed of the tool, and how far a prediction is from it.
//
// Frames: M instrument, T tool (target). A residual is measured minus predicted *at the tool
// point*, in axes of M: position p_MT_measured - p_MT_predicted in m, rotation Log(R_MT_measured *
// R_MT_predicted^T) in rad; for an axis the two components, perpendicular to the measured axis, of
// the rotation vector that carries the predicted axis to it. Position and rotation are taken
// separately (chapter-notes 14), so orientation noise does not leak into position.
#pragma once

#include <Eigen/Core>
#include <string_view>

#include "core/geometry/pose.h"

namespace truepose {

enum class ObservationKind { kPose = 0, kPoint = 1, kPointAxis = 2 };

struct Reading {
  Eigen::VectorXd q;  // chain joints, rad or m
  int placement = 0;  // which X_MB
  int target = 0;     // which X_FT
  ObservationKind kind = ObservationKind::kPose;
  Pose X_MT;  // measured; R is used by kPose only
  Eigen::Vector3d axis_M =
      Eigen::Vector3d::UnitZ();  // measured unit z axis of T, used by kPointAxis only
  Eigen::Vector3d position_sd_m =
      Eigen::Vector3d::Zero();  // stated, per axis of M; 0 where none is stated
  int id = 0;                   // the caller's name for it
};

// Residual rows: 3 of position, then `rotation_rows`. At most 6.
using Residual = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using ResidualByTwist = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor, 6, 6>;

// One row of the registry: everything that differs between kinds of measurement.
struct MeasurementKind {
  ObservationKind kind;
  std::string_view name;
  int rotation_rows;
  // @param X_MT predicted pose. @param r sized by the function. @param D nullptr, or the derivative
  // of r by the twist
  //   [v; w] of the tool: velocity of its point and angular velocity, both in M.
  void (*evaluate)(const Reading& reading, const Pose& X_MT, Residual* r, ResidualByTwist* D);
};

const MeasurementKind& KindOf(ObservationKind kind);
int RowsOf(const Reading& reading);

}  // namespace truepose
