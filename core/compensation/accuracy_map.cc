#include "core/compensation/accuracy_map.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose {
namespace {

using compensation::Arm;

constexpr int kMostAlong = 200, kMostPoints = 1'000'000;

absl::Status CheckSpec(const AccuracyMapSpec& spec, const Arm& arm) {
  FaultList faults;
  TableSpec box;
  box.box = spec.box;
  faults.AddAll(Validate(box, arm));
  double all = 1;
  for (int along : spec.points) all *= along;
  const bool sensible = std::all_of(spec.points.begin(), spec.points.end(),
                                    [](int n) { return n >= 1 && n <= kMostAlong; });
  if (!sensible || all > kMostPoints)
    faults.Add("points", absl::StrCat(spec.points[0], " x ", spec.points[1], " x ", spec.points[2]),
               absl::StrCat("1 to ", kMostAlong, " along each axis, ", kMostPoints, " in all"));
  return faults.ToStatus();
}

// A single point along an axis stands in the middle.
double Along(double low, double high, int at, int count) {
  return count == 1 ? (low + high) / 2 : low + (high - low) * at / (count - 1);
}

Eigen::Vector3d PointAt(const AccuracyMapSpec& spec, int i) {
  Eigen::Vector3d p;
  for (int axis = 0; axis < 3; ++axis) {
    const int count = spec.points[static_cast<size_t>(axis)];
    p(axis) = Along(spec.box.box_B.min()(axis), spec.box.box_B.max()(axis), i % count, count);
    i /= count;
  }
  return p;
}

AccuracyPoint AccuracyOf(const TableAxes& chain, const AccuracySources& sources,
                         const Eigen::Vector3d& p_F_tool, const Eigen::Vector3d& p_BT,
                         PoseFinder* finder) {
  AccuracyPoint point;
  point.p_BT = p_BT;
  Place place = Place::Zero();
  place.head<3>() = p_BT;
  const auto q_chain = finder->Reach(place);
  if (!q_chain) return point;
  point.reached = true;
  point.q = chain.ToController(*q_chain);
  point.accuracy = AccuracyAt(sources, *q_chain, p_F_tool);
  return point;
}

absl::Status Summarise(AccuracyMap* map) {
  std::vector<Eigen::Matrix3d> covariances;
  double squares = 0;
  for (size_t i = 0; i < map->points.size(); ++i) {
    const AccuracyPoint& point = map->points[i];
    if (!point.reached) continue;
    const auto farther = [&](size_t other) {
      return point.accuracy.position_95_m > map->points[other].accuracy.position_95_m;
    };
    if (covariances.empty() || farther(map->worst)) map->worst = i;
    if (covariances.empty() || !farther(map->best)) map->best = i;
    covariances.push_back(point.accuracy.covariance);
    squares += point.accuracy.covariance.trace();
  }
  map->reached = static_cast<int>(covariances.size());
  if (map->reached == 0) {
    FaultList faults;
    faults.Add(
        "box", "no point of it is reached",
        "places that the arm reaches from its reference joints without passing a singularity");
    return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
  }
  map->rms_m = std::sqrt(squares / map->reached);
  map->position_95_m = Radius95(covariances);
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<AccuracyMap> MapAccuracy(const Arm& arm, const AccuracySources& sources,
                                        const AccuracyMapSpec& spec, const Hooks& hooks) {
  TRUEPOSE_RETURN_IF_ERROR(CheckSpec(spec, arm));
  const TableAxes chain(arm, JointMatrix::Identity(arm.nominal.joints, arm.nominal.joints));
  PoseFinder finder(arm, spec.box);
  AccuracyMap map;
  const int count = spec.points[0] * spec.points[1] * spec.points[2];
  for (int i = 0; i < count; ++i) {
    if (hooks.Cancelled()) return absl::CancelledError("cancelled while mapping the accuracy");
    hooks.Report({"accuracy", static_cast<double>(i) / count});
    map.points.push_back(AccuracyOf(chain, sources, spec.box.X_FT.p, PointAt(spec, i), &finder));
  }
  TRUEPOSE_RETURN_IF_ERROR(Summarise(&map));
  return map;
}

}  // namespace truepose
