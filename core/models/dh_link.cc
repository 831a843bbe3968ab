#include "core/models/dh_link.h"

#include <Eigen/Geometry>
#include <cmath>

namespace truepose {
namespace {

// Hayati needs an angle of error / l to move the next axis sideways: 0.05 rad for half a millimetre
// at this length.
constexpr double kCoincident = 0.01;

// Lengths below this are rounding, and give no direction.
constexpr double kNoLength = 1e-12;

constexpr Motion kTurn = Motion::kRotation;
constexpr Motion kShift = Motion::kTranslation;

// The next axis in frame i-1.
AxisLine InFrame(const Pose& X, const AxisLine& line) {
  return {X.R.transpose() * line.u, X.R.transpose() * (line.p - X.p)};
}

// x of frame i along the common normal of z and `next`; from axis to axis, or where they meet as
// near to the old x as it can be.
Eigen::Vector3d NormalTo(const AxisLine& next) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitZ().cross(next.u).normalized();
  const double l = next.p.dot(x);
  if (std::abs(l) > kNoLength) return l > 0 ? x : Eigen::Vector3d(-x);
  const bool ahead = std::abs(x.x()) > kNoLength ? x.x() > 0 : x.y() > 0;
  return ahead ? x : Eigen::Vector3d(-x);
}

Link DenavitHartenberg(const AxisLine& next, LinkStart start) {
  const Eigen::Vector3d x = NormalTo(next), y = Eigen::Vector3d::UnitZ().cross(x);
  const double foot = -next.p.dot(y) / next.u.dot(y);  // of the common normal, along `next`
  return {{kTurn, Axis::kZ, std::atan2(x.y(), x.x()), "theta", start == LinkStart::kRevolute},
          {kShift, Axis::kZ, next.p.z() + foot * next.u.z(), "h", start == LinkStart::kPrismatic},
          {kShift, Axis::kX, next.p.dot(x), "l"},
          {kTurn, Axis::kX, std::atan2(-next.u.dot(y), next.u.z()), "phi"}};
}

// Where `next` meets the plane z = 0 of frame i-1.
Eigen::Vector3d Crossing(const AxisLine& next) {
  return next.p - next.u * (next.p.z() / next.u.z());
}

// The two rotations with R(x, first) R(y, second) z = u, second within +-90 deg.
struct TwoAngles {
  double about_x, about_y;
};

TwoAngles AnglesTo(const Eigen::Vector3d& u) {
  return {std::atan2(-u.y(), u.z()), std::atan2(u.x(), std::hypot(u.y(), u.z()))};
}

Link Hayati(const AxisLine& next, LinkStart start) {
  const Eigen::Vector3d c = Crossing(next);
  const double theta = std::atan2(c.y(), c.x());
  const TwoAngles angles =
      AnglesTo(Eigen::AngleAxisd(-theta, Eigen::Vector3d::UnitZ()).toRotationMatrix() * next.u);
  return {{kTurn, Axis::kZ, theta, "theta", start == LinkStart::kRevolute},
          {kShift, Axis::kX, std::hypot(c.x(), c.y()), "l"},
          {kTurn, Axis::kX, angles.about_x, "phi"},
          {kTurn, Axis::kY, angles.about_y, "beta"}};
}

// Eq. 33. The base has no theta: there a and b, alpha and beta are all that the axis has.
Link Coincident(const AxisLine& next, LinkStart start) {
  const Eigen::Vector3d c = Crossing(next);
  const TwoAngles angles = AnglesTo(next.u);
  Link link;
  if (start == LinkStart::kRevolute) link.push_back({kTurn, Axis::kZ, 0, "theta", true});
  link.push_back({kShift, Axis::kX, c.x(), "a"});
  link.push_back({kShift, Axis::kY, c.y(), "b"});
  link.push_back({kTurn, Axis::kX, angles.about_x, "alpha"});
  link.push_back({kTurn, Axis::kY, angles.about_y, "beta"});
  return link;
}

// The prismatic line goes through next.p (WithPrismaticPlaced): h = 0 at nominal.
Link ParallelPrismatic(const AxisLine& next) {
  const TwoAngles angles = AnglesTo(next.u);
  return {{kShift, Axis::kZ, next.p.z(), "l", true},
          {kShift, Axis::kY, next.p.y(), "h"},
          {kTurn, Axis::kX, angles.about_x, "phi"},
          {kTurn, Axis::kY, angles.about_y, "beta"}};
}

}  // namespace

Link LinkTo(const Pose& X, LinkStart start, const AxisLine& next_B) {
  const AxisLine next = InFrame(X, next_B);
  if (!AreParallel(Eigen::Vector3d::UnitZ(), next.u)) return DenavitHartenberg(next, start);
  if (start == LinkStart::kPrismatic) return ParallelPrismatic(next);
  return Crossing(next).head<2>().norm() < kCoincident ? Coincident(next, start)
                                                       : Hayati(next, start);
}

Link LastLink(JointType type, const Eigen::Vector3d& p) {
  const bool revolute = type == JointType::kRevolute;
  const Link turns = {{kTurn, Axis::kZ, 0, "gamma", revolute},
                      {kTurn, Axis::kY, 0, "beta"},
                      {kTurn, Axis::kX, 0, "alpha"}};
  const Link shifts = {{kShift, Axis::kZ, p.z(), "c", !revolute},
                       {kShift, Axis::kY, p.y(), "b"},
                       {kShift, Axis::kX, p.x(), "a"}};
  Link link = revolute ? turns : shifts;
  const Link& rest = revolute ? shifts : turns;
  link.insert(link.end(), rest.begin(), rest.end());
  return link;
}

Pose After(Pose X, const Link& link) {
  for (const LinkElement& element : link) Apply(element.motion, element.axis, element.value, &X);
  return X;
}

}  // namespace truepose
