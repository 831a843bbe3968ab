// A UR10 that is calibrated, left alone or changed, and checked.
#pragma once

#include <memory>
#include <string>

#include "core/base/random.h"
#include "core/calibrate/calibrate.h"
#include "core/drift/drift_check.h"

namespace truepose::testing {

// What is realistic: experiments E5 and E7.
struct DriftDesign {
  double length_error_sd_m = 3e-4;          // of manufacture
  double angle_error_sd_rad = 5.236e-4;     // 0.03 deg
  double position_noise_sd_m = 5e-5;        // of the instrument, per axis
  double rotation_noise_sd_rad = 1.745e-4;  // 0.01 deg
  // What the model can't explain: gear errors of each joint, once, twice and 100 times a turn.
  double once_rad = 1e-4, twice_rad = 5e-5, gear_rad = 1e-4;
  int calibration_poses = 60;
  double range_rad = 1;  // of all poses, about home
};

// One robot, its calibration by a noisy session, and checks of it.
class DriftSimulation {
 public:
  DriftSimulation(const DriftDesign& design, uint64_t seed);
  DriftSimulation(const DriftSimulation&) = delete;

  // The parts that can change; "" is no change.
  static std::vector<std::string> Parts();
  // Joints 2 to 5 by 0.02 deg, base and tool by 0.5 mm in any direction.
  void Change(const std::string& part);
  // A joint by any angle.
  void TurnJoint(int joint, double angle_rad) { offset_(joint) += angle_rad; }

  // A check of so many new poses; as it was asked, when frames are held or not.
  DriftProblem Check(int poses, bool hold_base = true, bool hold_tool = true);
  // Poses about a place in joint space.
  DriftProblem CheckWithin(int poses, const Eigen::VectorXd& home, double range_rad);

  const CalibrationResult& calibration() const { return *calibration_; }
  Eigen::VectorXd home() const;

 private:
  Reading Measure(const Eigen::VectorXd& q);
  std::vector<Reading> Session(int poses, const Eigen::VectorXd& home, double range_rad);
  Eigen::Vector3d Vector(double sd);

  DriftDesign design_;
  Random random_;
  Robot robot_;
  Model model_;
  Eigen::VectorXd lambda_, offset_;
  Eigen::Matrix<double, 6, 3> amplitude_, phase_;
  Pose X_MB_, X_FT_;
  std::unique_ptr<CalibrationResult> calibration_;
};

// A check against a calibration of one placement and one target, both held.
DriftProblem DriftProblemOf(const Robot& robot, const CalibrationResult& calibration,
                            std::vector<Reading> readings);

}  // namespace truepose::testing
