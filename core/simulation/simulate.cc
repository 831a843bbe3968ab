#include "core/simulation/simulate.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace truepose {
namespace {

Eigen::VectorXd DrawErrors(const Model& model, const SimulateOptions& options, Random* random) {
  Eigen::VectorXd lambda(model.parameters.size());
  for (Eigen::Index i = 0; i < lambda.size(); ++i) {
    const bool angle = model.parameters[static_cast<int>(i)].is_angle();
    lambda(i) = (angle ? options.angle_error_sd_rad : options.length_error_sd_m) * random->Normal();
  }
  return lambda;
}

// An instrument that stands within 3 m of the robot, turned as it happens to be.
Pose DrawInstrument(Random* random) {
  Pose X_MB;
  for (int i = 0; i < 3; ++i) X_MB.p(i) = random->Uniform(-3, 3);
  Eigen::Vector3d r;
  for (int i = 0; i < 3; ++i) r(i) = random->Uniform(-1.8, 1.8);
  X_MB.R = ExpRotation<double>(r);
  return X_MB;
}

Eigen::VectorXd DrawJoints(const Robot& robot, const SimulateOptions& options, Random* random) {
  Eigen::VectorXd q = robot.MiddleOfLimits();
  for (int i = 0; i < robot.joint_count(); ++i) {
    const Joint& joint = robot.joints()[i];
    const double range =
        joint.type == JointType::kRevolute ? options.joint_range_rad : options.prismatic_range_m;
    q(i) =
        random->Uniform(std::max(joint.lower, q(i) - range), std::min(joint.upper, q(i) + range));
  }
  return q;
}

Eigen::Vector3d DrawNoise(double sd, Random* random) {
  Eigen::Vector3d noise;
  for (int i = 0; i < 3; ++i) noise(i) = sd * random->Normal();
  return noise;
}

double Read(double q, const SimulateOptions& options, Random* random) {
  const double noisy = q + options.joint_noise_sd * random->Normal();
  if (options.encoder_resolution <= 0) return noisy;
  return options.encoder_resolution * std::round(noisy / options.encoder_resolution);
}

}  // namespace

SimulatedSession Simulate(const Robot& robot, const Model& model, const Pose& X_FT,
                          const SimulateOptions& options) {
  Random random(options.seed);
  SimulatedSession session;
  session.lambda = DrawErrors(model, options, &random);
  session.X_MB = DrawInstrument(&random);
  session.X_FT = X_FT;
  for (int i = 0; i < options.poses; ++i) {
    const Eigen::VectorXd q = DrawJoints(robot, options, &random);
    const Pose X_BF = Forward(model, robot.joint_map().ToChain(q), session.lambda);
    Pose X_MT = session.X_MB * X_BF * session.X_FT;
    X_MT.p += DrawNoise(options.position_noise_sd_m, &random);
    X_MT.R = ExpRotation<double>(DrawNoise(options.rotation_noise_sd_rad, &random)) * X_MT.R;
    Eigen::VectorXd read(q.size());
    for (Eigen::Index j = 0; j < q.size(); ++j) read(j) = Read(q(j), options, &random);
    session.readings.push_back({read, X_MT});
  }
  return session;
}

}  // namespace truepose
