#include "tests/core/testing/models.h"

#include <Eigen/Dense>
#include <cstdlib>
#include <iostream>

namespace truepose::testing {
namespace {

template <typename T>
T ValueOrAbort(absl::StatusOr<T> value) {
  if (!value.ok()) {
    std::cerr << value.status() << "\n";
    std::abort();
  }
  return *std::move(value);
}

ElementaryTransform Moving(Motion motion, Axis axis, int joint) {
  return {motion, axis, 0.0, joint, -1};
}

Robot RobotOf(const Chain& chain) {
  std::vector<Joint> joints;
  for (const ElementaryTransform& element : chain) {
    if (element.joint < 0) continue;
    joints.push_back({"j" + std::to_string(element.joint + 1), element.motion == Motion::kRotation
                                                                   ? JointType::kRevolute
                                                                   : JointType::kPrismatic});
  }
  const int n = static_cast<int>(joints.size());
  return ValueOrAbort(Robot::Create(joints, chain, JointMap::Identity(n)));
}

// Joints about x, y and z, a prismatic one among them, as a URDF gives them.
Robot MixedAxes() {
  return RobotOf({Translation(Axis::kX, 0.3), Moving(Motion::kRotation, Axis::kX, 0),
                  Translation(Axis::kY, 0.4), Moving(Motion::kRotation, Axis::kY, 1),
                  Translation(Axis::kZ, 0.5), Moving(Motion::kTranslation, Axis::kX, 2),
                  Rotation(Axis::kZ, 0.2), Moving(Motion::kRotation, Axis::kX, 3),
                  Translation(Axis::kX, 0.2), Moving(Motion::kRotation, Axis::kZ, 4),
                  Translation(Axis::kZ, 0.1), Rotation(Axis::kY, 90 * kDeg)});
}

// Axes 2 and 3 in opposite directions, 4 almost parallel to 3, 5 skew to 4; the last one prismatic.
Robot AwkwardAxes() {
  return RobotOf({Translation(Axis::kZ, 0.2),
                  Rotation(Axis::kY, 0.7),
                  Moving(Motion::kRotation, Axis::kZ, 0),
                  Translation(Axis::kX, 0.1),
                  Rotation(Axis::kX, 1.2),
                  Moving(Motion::kRotation, Axis::kZ, 1),
                  Translation(Axis::kX, 0.5),
                  Translation(Axis::kZ, 0.1),
                  Rotation(Axis::kX, 180 * kDeg),
                  Moving(Motion::kRotation, Axis::kZ, 2),
                  Translation(Axis::kY, 0.4),
                  Rotation(Axis::kX, 0.02),
                  Rotation(Axis::kY, -0.03),
                  Moving(Motion::kRotation, Axis::kZ, 3),
                  Translation(Axis::kY, 0.1),
                  Rotation(Axis::kY, 0.8),
                  Translation(Axis::kZ, 0.3),
                  Moving(Motion::kRotation, Axis::kX, 4),
                  Translation(Axis::kZ, 0.1),
                  Moving(Motion::kTranslation, Axis::kZ, 5),
                  Rotation(Axis::kY, -90 * kDeg)});
}

// A prismatic joint whose next axis is parallel and stands beside it.
Robot PrismaticBesideRevolute() {
  return RobotOf({Moving(Motion::kRotation, Axis::kZ, 0), Translation(Axis::kX, 0.3),
                  Rotation(Axis::kX, 90 * kDeg), Moving(Motion::kTranslation, Axis::kZ, 1),
                  Translation(Axis::kX, 0.1), Translation(Axis::kY, 0.2),
                  Moving(Motion::kRotation, Axis::kZ, 2), Translation(Axis::kX, 0.1),
                  Rotation(Axis::kX, 90 * kDeg), Moving(Motion::kRotation, Axis::kZ, 3),
                  Translation(Axis::kZ, 0.1)});
}

template <typename Block>
Eigen::MatrixXd Stack(const Robot& robot, int poses, uint64_t seed, Eigen::Index columns,
                      Block block) {
  Random random(seed);
  Eigen::MatrixXd J(6 * poses, columns);
  for (int i = 0; i < poses; ++i)
    J.middleRows<6>(6 * i) = block(RandomVector(robot.joint_count(), 1.5, &random));
  return J;
}

}  // namespace

Model ModelOf(const std::string& kind, const Robot& robot, ModelExtent extent) {
  return ValueOrAbort(BuildModel(kind, robot, extent));
}

Eigen::MatrixXd StackedJacobian(const Robot& robot, const Model& model, int poses, uint64_t seed) {
  const Eigen::VectorXd lambda = Eigen::VectorXd::Zero(model.parameters.size());
  ModelSweep sweep;
  return Stack(robot, poses, seed, lambda.size(), [&](const Eigen::VectorXd& q) {
    RunSweep(model, q.data(), lambda.data(), {}, &sweep);
    Eigen::MatrixXd twists = sweep.J_parameters;
    for (Eigen::Index k = 0; k < twists.cols(); ++k)
      twists.col(k) = TwistAt(sweep.X_BF.p, sweep.J_parameters.col(k));
    return twists;
  });
}

Eigen::MatrixXd StackedBaseMotions(const Robot& robot, int poses, uint64_t seed) {
  return Stack(robot, poses, seed, 6, [&](const Eigen::VectorXd& q) {
    const Pose X = Forward<double>(robot.chain(), q.data(), nullptr);
    Eigen::Matrix<double, 6, 6> twists = Eigen::Matrix<double, 6, 6>::Identity();
    for (int k = 0; k < 6; ++k) twists.col(k) = TwistAt(X.p, twists.col(k));
    return twists;
  });
}

Eigen::MatrixXd StackedToolMotions(const Robot& robot, int poses, uint64_t seed) {
  return Stack(robot, poses, seed, 6, [&](const Eigen::VectorXd& q) {
    const Pose X = Forward<double>(robot.chain(), q.data(), nullptr);
    Eigen::Matrix<double, 6, 6> twists = Eigen::Matrix<double, 6, 6>::Zero();
    twists.topLeftCorner<3, 3>() = twists.bottomRightCorner<3, 3>() = X.R;
    return twists;
  });
}

int RankOf(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd scaled = columns;
  scaled.colwise().normalize();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
  qr.setThreshold(1e-9);
  return static_cast<int>(qr.rank());
}

Eigen::MatrixXd Columns(const Eigen::MatrixXd& J, const Model& model,
                        const std::vector<std::string>& names) {
  Eigen::MatrixXd columns(J.rows(), static_cast<Eigen::Index>(names.size()));
  for (size_t i = 0; i < names.size(); ++i)
    columns.col(static_cast<Eigen::Index>(i)) = J.col(model.parameters.Find(names[i]).value());
  return columns;
}

Eigen::MatrixXd SideBySide(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd both(a.rows(), a.cols() + b.cols());
  both << a, b;
  return both;
}

Robot StanfordBesideBase() {
  Chain chain = Stanford().chain();
  chain.insert(chain.begin(), Translation(Axis::kX, 0.2));
  return ValueOrAbort(Robot::Create(Stanford().joints(), chain, JointMap::Identity(6)));
}

std::vector<NamedRobot> AllRobots() {
  std::vector<NamedRobot> robots;
  for (const CountedRobot& counted : CountedRobots())
    robots.push_back({counted.name, counted.robot});
  robots.push_back({"measuring arm", MeasuringArm()});
  robots.push_back({"Stanford beside its base", StanfordBesideBase()});
  robots.push_back({"mixed axes", MixedAxes()});
  robots.push_back({"awkward axes", AwkwardAxes()});
  robots.push_back({"prismatic beside revolute", PrismaticBesideRevolute()});
  return robots;
}

}  // namespace truepose::testing
