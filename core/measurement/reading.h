// What an instrument observed of the tool, and how far a prediction is from it.
//
// Frames: M instrument, T tool (target). A residual is measured minus predicted *at the tool
// point*, in axes of M: position p_MT_measured - p_MT_predicted in m, rotation Log(R_MT_measured *
// R_MT_predicted^T) in rad; for an axis the two components, perpendicular to the measured axis, of
// the rotation vector that carries the predicted axis to it; for a plane n . (p_MT_measured -
// p_MT_predicted), along its normal n alone. Position and rotation are taken
// separately (chapter-notes 14), so orientation noise does not leak into position.
//
// What looks like further kinds is one of these with the right frame M:
//   several points a reading   readings of kPoint with a target each
//   ball in sockets            kPoint at the socket's place in a frame M of the socket block
//   distance to an unknown point   kDistance to the origin of a placement of its own
//   difference of distances    kDistance with an unknown constant (Reading::offset)
//   pose matching              kPose or kPointAxis at the fixture's pose, with joint_sd
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/geometry/pose.h"
#include "core/robot/conditions.h"

namespace truepose {

enum class ObservationKind {
  kPose = 0,
  kPoint = 1,
  kPointAxis = 2,
  kCoordinates = 3,
  kDistance = 4,
  kPlane = 5
};

struct Reading {
  Eigen::VectorXd q;  // chain joints as read, rad or m
  Conditions conditions;
  int placement = 0;  // which X_MB
  int target = 0;     // which X_FT
  int offset = -1;    // which unknown constant is added to the distance; -1 none
  ObservationKind kind = ObservationKind::kPose;
  Pose X_MT;  // measured; R is used by kPose only
  Eigen::Vector3d axis_M =
      Eigen::Vector3d::UnitZ();  // measured unit z axis of T, used by kPointAxis only
  Eigen::Vector3d normal_M = Eigen::Vector3d::UnitZ();   // kPlane: of the plane through X_MT.p
  std::array<bool, 3> coordinates = {true, true, true};  // which of x, y, z kCoordinates has
  Eigen::Vector3d anchor_M = Eigen::Vector3d::Zero();    // kDistance: measured from here
  double distance_m = 0;                                 // kDistance: the measured value
  // Stated uncertainty, each zero or empty where none is stated. A distance takes position_sd_m
  // along its line, a plane along its normal.
  Eigen::Vector3d position_sd_m = Eigen::Vector3d::Zero();  // per axis of M
  double rotation_sd_rad = 0;                               // per axis
  Eigen::VectorXd joint_sd;  // of q; rad or m; carried through the joint Jacobian
  std::optional<Eigen::Matrix<double, 6, 6>> covariance;  // of (position, rotation) in axes of M,
                                                          // added to the two above
  bool contact = false;  // the place is that of a fixture and not of an instrument: frames of M
                         // that its places leave free (a turn about a line of sockets) are no fault
  double weight = 1;     // of a robust loss: the whole covariance is divided by it
  int id = 0;            // the caller's name for it
  int row = -1;  // of the session; readings of one row were taken at one stand of the joints
                 // and share their noise. -1: a row of its own
};

// Units, what is seen independently of each other: a number from 0 for each reading, in the order
// of first reading, equal for equal rows; a row of -1 is a unit of its own.
struct Units {
  std::vector<int> of;  // a reading each
  int count = 0;
};
Units UnitsOfRows(const std::vector<int>& rows);

// Residual rows: position rows, then rotation rows. At most 6.
using Residual = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using ResidualByTwist = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor, 6, 6>;

// One row of the registry: everything that differs between kinds of measurement.
struct MeasurementKind {
  ObservationKind kind;
  std::string_view name;
  int position_rows;  // of kCoordinates at most; see PositionRowsOf
  int rotation_rows;
  // @param X_MT predicted pose. @param r sized by the function. @param D nullptr, or the derivative
  // of r by the twist
  //   [v; w] of the tool: velocity of its point and angular velocity, both in M.
  void (*evaluate)(const Reading& reading, const Pose& X_MT, Residual* r, ResidualByTwist* D);
};

const MeasurementKind& KindOf(ObservationKind kind);
int PositionRowsOf(const Reading& reading);
int RotationRowsOf(const Reading& reading);
int RowsOf(const Reading& reading);

}  // namespace truepose
