// Exact compensation: controller joints at which the *identified* flange stands where the nominal
// one would, from B to F only; base, tool and work frames are not touched.
//
//   6 joints   the square system; the solution near the nominal one.
//   more       least change of the joints: |q - q_nominal| is least among all joints that reach the
//              pose (effects moved; prismatic joints over the characteristic length).
//   fewer      least squares in the coordinates that matter (point_F, weight); what is left is
//              reported.
// Within the limits of the controller's joints. Outcomes:
//   kOk               reached to the tolerances; fewer than six joints: the least remainder.
//   kNearSingular     joints move by more than 0.1 / singular_threshold times the error they undo,
//                     and the nominal or the corrected place is nearer to a singularity than
//                     singular_threshold (singularity.h), or is in another configuration; or the
//                     pose is not reached and the nominal place is that near. Fewer than six
//                     joints: the weighted coordinates hardly tell where a joint should be, so that
//                     the least remainder is far away (the first condition alone) or was not found.
//   kBeyondLimit      reached only beyond the limit of `joint`; q is the best within all limits.
//   kUnreachable      not reached from the nominal place nor from 100 others around it: q is the
//                     nearest pose that was found, 1 rad counting as the characteristic length;
//                     with fewer joints point_F is missed (largest_position_miss_m).
//   kInvalidArgument  a number that is not finite, a pose that is no rotation, or a measuring arm.
// A pure function of its arguments: any number of threads may share an Arm.
#pragma once

#include "compensation/kinematics.h"
#include "compensation/outcome.h"

namespace truepose::compensation {

struct ExactOptions {
  double position_tolerance_m = 1e-10;
  double rotation_tolerance_rad = 1e-10;
  double singular_threshold = 1e-3;
  double characteristic_length_m = 0;  // 0: CharacteristicLength of the nominal chain
  int max_iterations = 100;            // of the slow way; the usual case takes two or three
  // Fewer than six joints: which point of the flange is put into place, and how much its three
  // position and three rotation coordinates count, in the flange frame. By default position comes
  // first: 1 rad counts as 1 mm.
  Eigen::Vector3d point_F = Eigen::Vector3d::Zero();
  std::array<double, 6> weight = {1, 1, 1, 1e-3, 1e-3, 1e-3};
  // Fewer than six joints: a pose whose point even the nominal arm misses by more is unreachable.
  double largest_position_miss_m = 1e-6;
};

// The pose is that of the nominal flange at q. @param q controller joints of the target, as many as
// the arm has.
Correction CorrectJoints(const Arm& arm, const double* q_controller,
                         const ExactOptions& options) noexcept;

// @param q_seed controller joints near the wanted solution: the nominal configuration nearest to
// them is kept (inverse.h).
Correction CorrectPose(const Arm& arm, const Pose& X_BF, const double* q_seed_controller,
                       const ExactOptions& options) noexcept;

// Where the tip of an arm really is whose joints were read: the identified X_BF X_FT.
struct Tip {
  Outcome outcome = Outcome::kInvalidArgument;  // or kOk
  Pose X_BT;
  Eigen::Vector3d axis_B = Eigen::Vector3d::UnitZ();  // of axis_T
};

// Of any arm, measuring or not.
Tip CorrectedTip(const Arm& arm, const double* q_controller, const Pose& X_FT,
                 const Eigen::Vector3d& axis_T) noexcept;

}  // namespace truepose::compensation
