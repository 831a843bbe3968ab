#include "core/reproduce/readings_of_dime.h"

#include <algorithm>
#include <cmath>

#include "core/base/status_macros.h"

namespace truepose {
namespace {

bool IsMain(const std::string& name) {
  const std::vector<std::string>& names = ReducedSet();
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Mean distance between the hole and where nominal parameters put the tip.
absl::StatusOr<double> MeanNominalError(const Model& model, const Eigen::VectorXd& lambda) {
  const std::vector<DimePose> dime = Dime();
  const Eigen::VectorXd nominal = Eigen::VectorXd::Zero(lambda.size());
  double sum = 0;
  for (const DimePose& pose : dime) {
    TRUEPOSE_ASSIGN_OR_RETURN(const Eigen::VectorXd q, JointsAt(model, lambda, pose));
    sum += (Forward(model, q, nominal).p - pose.hole.p_M).norm();
  }
  return sum / static_cast<double>(dime.size());
}

// The errors of the main parameters and those of the others, in vectors of all.
struct Drawn {
  Eigen::VectorXd main, other;
};

Drawn Draw(const Model& model, const DimeTruth& truth, Random* random) {
  const int n = model.parameters.size();
  Drawn drawn = {Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  for (int i = 0; i < n; ++i) {
    const Parameter& parameter = model.parameters[i];
    if (IsMain(parameter.name)) {
      drawn.main(i) = random->Normal() *
                      (parameter.is_angle() ? truth.main_angle_sd_rad : truth.main_length_sd_m);
    } else {
      drawn.other(i) = random->Normal() *
                       (parameter.is_angle() ? truth.other_angle_sd_rad : truth.other_length_sd_m);
    }
  }
  return drawn;
}

// Of a tilt about two axes.
double TiltSdPerAxis(const DimeNoise& noise) { return noise.tilt_rms_rad / std::sqrt(2.0); }

// The hole as the operator's hand finds it: shaken in place and, about two axes across it, in
// direction.
Hole Shaken(const Hole& hole, const DimeNoise& noise, Random* random) {
  Hole shaken = hole;
  Eigen::Vector3d turn;
  for (int i = 0; i < 3; ++i) shaken.p_M(i) += noise.position_sd_m * random->Normal();
  for (int i = 0; i < 3; ++i) turn(i) = TiltSdPerAxis(noise) * random->Normal();
  shaken.axis_M = ExpRotation<double>(turn) * hole.axis_M;  // what is about the axis moves nothing
  return shaken;
}

Reading AsRead(const DimePose& pose, const Eigen::VectorXd& q, const DimeNoise& noise) {
  Reading reading;
  reading.kind = ObservationKind::kPointAxis;
  reading.X_MT.p = pose.hole.p_M;
  reading.axis_M = pose.hole.axis_M;
  reading.q = noise.resolution_rad * (q / noise.resolution_rad).array().round();
  reading.position_sd_m.setConstant(noise.position_sd_m);
  reading.rotation_sd_rad = TiltSdPerAxis(noise);
  reading.joint_sd = Eigen::VectorXd::Constant(q.size(), noise.resolution_rad / std::sqrt(12.0));
  reading.contact = true;
  return reading;
}

}  // namespace

absl::StatusOr<Eigen::VectorXd> DrawTruth(const Model& measuring_robot, const DimeTruth& truth,
                                          Random* random) {
  constexpr int kMostRounds = 50;
  constexpr double kNear = 1e-9;  // m
  const Drawn drawn = Draw(measuring_robot, truth, random);
  // The error is nearly s |main| for the scale s, a little more where the others matter: the ratio
  // converges in a few rounds.
  double scale = 1;
  for (int round = 0; round < kMostRounds; ++round) {
    const Eigen::VectorXd lambda = scale * drawn.main + drawn.other;
    TRUEPOSE_ASSIGN_OR_RETURN(const double mean, MeanNominalError(measuring_robot, lambda));
    if (std::abs(mean - truth.mean_error_m) < kNear) return lambda;
    scale *= truth.mean_error_m / mean;
  }
  return absl::FailedPreconditionError("no scale of the errors gives the mean position error");
}

absl::StatusOr<std::vector<Reading>> ReadDime(const Model& measuring_robot,
                                              const Eigen::VectorXd& truth, const DimeNoise& noise,
                                              Random* random) {
  std::vector<Reading> readings;
  for (const DimePose& pose : Dime()) {
    DimePose shaken = pose;
    shaken.hole = Shaken(pose.hole, noise, random);
    TRUEPOSE_ASSIGN_OR_RETURN(const Eigen::VectorXd q, JointsAt(measuring_robot, truth, shaken));
    readings.push_back(AsRead(pose, q, noise));
    readings.back().id = static_cast<int>(readings.size()) - 1;
  }
  return readings;
}

}  // namespace truepose
