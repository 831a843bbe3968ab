#include "core/models/axis_lines.h"

#include <Eigen/Geometry>

namespace truepose {
namespace {

Eigen::Vector3d FootOn(const AxisLine& line, const Eigen::Vector3d& point) {
  return line.p + line.u * line.u.dot(point - line.p);
}

}  // namespace

std::vector<AxisLine> AxisLines(const Robot& robot) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(robot.joint_count());
  std::vector<AxisLine> lines;
  Pose X;
  for (const ElementaryTransform& element : robot.chain()) {
    if (element.joint >= 0) lines.push_back({X.R.col(static_cast<int>(element.axis)), X.p});
    Apply(element.motion, element.axis, ValueOf<double>(element, zero.data(), nullptr), &X);
  }
  return lines;
}

bool AreParallel(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  return u.cross(v).norm() < kParallelSine;
}

std::vector<AxisLine> WithPrismaticPlaced(const Robot& robot, std::vector<AxisLine> lines) {
  for (size_t i = lines.size(); i-- > 1;) {
    const bool prismatic = robot.joints()[i - 1].type == JointType::kPrismatic;
    if (!prismatic || !AreParallel(lines[i - 1].u, lines[i].u)) continue;
    lines[i].p = FootOn(lines[i], lines[i - 1].p);
    lines[i - 1].p = lines[i].p;
  }
  return lines;
}

}  // namespace truepose
