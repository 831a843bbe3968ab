#include "core/compensation/pose_samples.h"

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/compensation/pose_finder.h"

namespace truepose {
namespace {

Eigen::Vector3d DrawPosition(const Eigen::AlignedBox3d& box, double on_rim, Random* random) {
  Eigen::Vector3d p;
  for (int i = 0; i < 3; ++i) p(i) = random->Uniform(box.min()(i), box.max()(i));
  if (random->Uniform() >= on_rim) return p;
  const auto face = static_cast<Eigen::Index>(random->Below(3));
  p(face) = random->Below(2) == 0 ? box.min()(face) : box.max()(face);
  return p;
}

Eigen::Vector2d DrawTilt(double cone, double on_rim, Random* random) {
  const double radius = random->Uniform() < on_rim ? cone : cone * std::sqrt(random->Uniform());
  const double direction = random->Uniform(-std::numbers::pi, std::numbers::pi);
  return {radius * std::cos(direction), radius * std::sin(direction)};
}

}  // namespace

PoseSamples SamplePoses(const compensation::Arm& arm, const BoxDomain& box, int poses,
                        double on_rim, uint64_t seed) {
  PoseFinder finder(arm, box);
  Random random(seed);
  PoseSamples samples;
  for (int i = 0; i < poses; ++i) {
    Place place;
    place.head<3>() = DrawPosition(box.box_B, on_rim, &random);
    place.segment<2>(3) = DrawTilt(box.cone_rad, on_rim, &random);
    place(5) = random.Uniform(box.roll_lower_rad, box.roll_upper_rad);
    if (const auto q = finder.Reach(place))
      samples.q_chain.push_back(*q);
    else
      ++samples.unreachable;
  }
  return samples;
}

}  // namespace truepose
