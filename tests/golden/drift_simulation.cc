#include "tests/golden/drift_simulation.h"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>

#include "tests/core/testing/robots.h"

namespace truepose::testing {
namespace {

constexpr double kFrequency[] = {1, 2, 100};

}  // namespace

DriftProblem DriftProblemOf(const Robot& robot, const CalibrationResult& calibration,
                            std::vector<Reading> readings) {
  const Identification& identification = calibration.identification;
  DriftProblem problem;
  problem.robot = &robot;
  problem.check = {&calibration.model, std::move(readings), {""}, {""}};
  problem.active = identification.estimate;
  problem.base_held = problem.tool_held = {true};
  const int n = problem.check.CandidateCount();
  problem.covariance = Eigen::MatrixXd::Zero(n, n);
  const std::vector<int>& active = identification.set.active;
  problem.covariance(active, active) = identification.covariance;
  problem.model_error = identification.model_error;
  problem.redundancy = identification.rows - static_cast<int>(active.size());
  return problem;
}

DriftSimulation::DriftSimulation(const DriftDesign& design, uint64_t seed)
    : design_(design),
      random_(seed),
      robot_(Ur10()),
      model_(ModifiedIncremental(robot_, ModelExtent::kInternal)),
      lambda_(model_.parameters.size()),
      offset_(Eigen::VectorXd::Zero(6)) {
  for (Eigen::Index i = 0; i < lambda_.size(); ++i)
    lambda_(i) = random_.Normal() * (model_.parameters[static_cast<int>(i)].is_angle()
                                         ? design.angle_error_sd_rad
                                         : design.length_error_sd_m);
  const double sizes[] = {design.once_rad, design.twice_rad, design.gear_rad};
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 6; ++j) {
      amplitude_(j, k) = sizes[k];
      phase_(j, k) = random_.Uniform(0, 2 * std::numbers::pi);
    }
  }
  X_MB_ = {ExpRotation<double>(RandomVector(3, 1.8, &random_)), RandomVector(3, 3, &random_)};
  X_FT_ = {Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.02, -0.03, 0.1)};
  CalibrationProblem problem;
  problem.robot = &robot_;
  problem.placements = problem.targets = {""};
  problem.X_FT_nominal = X_FT_;
  problem.readings = Session(design.calibration_poses, home(), design.range_rad);
  problem.calibrates.assign(problem.readings.size(), true);
  auto result = Calibrate(problem, {}, {});
  if (!result.ok()) {
    std::cerr << result.status() << "\n";
    std::abort();
  }
  calibration_ = std::make_unique<CalibrationResult>(*std::move(result));
}

Eigen::VectorXd DriftSimulation::home() const {
  return (Eigen::VectorXd(6) << 0, -1.4, 1.8, -1.9, -1.6, 0).finished();
}

std::vector<std::string> DriftSimulation::Parts() {
  return {"base or joint 1", "joint 2", "joint 3", "joint 4", "joint 5", "tool or last joint"};
}

void DriftSimulation::Change(const std::string& part) {
  if (part == "base or joint 1") X_MB_.p += 5e-4 * Vector(1).normalized();
  if (part == "tool or last joint") X_FT_.p += 5e-4 * Vector(1).normalized();
  if (part.substr(0, 6) == "joint ") TurnJoint(std::stoi(part.substr(6)) - 1, 0.02 * kDeg);
}

DriftProblem DriftSimulation::Check(int poses, bool hold_base, bool hold_tool) {
  DriftProblem problem = CheckWithin(poses, home(), design_.range_rad);
  problem.base_held = {hold_base};
  problem.tool_held = {hold_tool};
  problem.X_FT_nominal = X_FT_;
  for (int i = 0; i < 2 * kFrameParameters; ++i) {
    if (i < kFrameParameters ? hold_base : hold_tool) continue;
    problem.covariance.row(i).setZero();
    problem.covariance.col(i).setZero();
  }
  return problem;
}

DriftProblem DriftSimulation::CheckWithin(int poses, const Eigen::VectorXd& home,
                                          double range_rad) {
  return DriftProblemOf(robot_, *calibration_, Session(poses, home, range_rad));
}

std::vector<Reading> DriftSimulation::Session(int poses, const Eigen::VectorXd& home,
                                              double range_rad) {
  std::vector<Reading> readings;
  for (int i = 0; i < poses; ++i) {
    readings.push_back(Measure(home + RandomVector(6, range_rad, &random_)));
    readings.back().id = i;
  }
  return readings;
}

Reading DriftSimulation::Measure(const Eigen::VectorXd& q) {
  Reading reading;
  reading.q = q;
  reading.position_sd_m.setConstant(design_.position_noise_sd_m);
  reading.rotation_sd_rad = design_.rotation_noise_sd_rad;
  Eigen::VectorXd q_true = q + offset_;
  for (int j = 0; j < 6; ++j) {
    for (int k = 0; k < 3; ++k)
      q_true(j) += amplitude_(j, k) * std::sin(kFrequency[k] * q(j) + phase_(j, k));
  }
  reading.X_MT = X_MB_ * Forward(model_, q_true, lambda_) * X_FT_;
  reading.X_MT.p += Vector(design_.position_noise_sd_m);
  reading.X_MT.R = ExpRotation<double>(Vector(design_.rotation_noise_sd_rad)) * reading.X_MT.R;
  return reading;
}

Eigen::Vector3d DriftSimulation::Vector(double sd) {
  Eigen::Vector3d v;
  for (double& value : v) value = sd * random_.Normal();
  return v;
}

}  // namespace truepose::testing
