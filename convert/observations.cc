#include "convert/observations.h"

#include <optional>
#include <utility>

#include "convert/frames.h"

namespace truepose::convert {
namespace {

// What can be seen of a pose, least first.
enum class Sight { kPoint, kPointAxis, kPose };

std::optional<Sight> Wanted(v1::Observe observe) {
  if (observe == v1::POINT) return Sight::kPoint;
  if (observe == v1::POINT_AXIS) return Sight::kPointAxis;
  if (observe == v1::POSE) return Sight::kPose;
  return std::nullopt;
}

ObservationKind KindShowing(Sight sight) {
  if (sight == Sight::kPose) return ObservationKind::kPose;
  return sight == Sight::kPointAxis ? ObservationKind::kPointAxis : ObservationKind::kPoint;
}

// The kind under `observe` of what shows `sight`; nullopt when more is asked for.
std::optional<ObservationKind> KindFor(Sight sight, v1::Observe observe) {
  const Sight wanted = Wanted(observe).value_or(sight);
  return sight < wanted ? std::nullopt : std::optional(KindShowing(wanted));
}

Sight SightOf(v1::FeatureKind kind) {
  if (kind == v1::FEATURE_POSE) return Sight::kPose;
  return kind == v1::FEATURE_POINT_AXIS ? Sight::kPointAxis : Sight::kPoint;
}

Sight SightOf(const v1::Reading& row) {
  if (row.has_orientation()) return Sight::kPose;
  return row.has_axis() ? Sight::kPointAxis : Sight::kPoint;
}

void SetPose(const Pose& X_MT, Reading* reading) {
  reading->X_MT = X_MT;
  reading->axis_M = reading->normal_M = X_MT.R.col(2);
}

void AddContact(const FeaturePlace& feature, v1::Observe observe, std::vector<Observation>* out) {
  const bool plane = feature.kind == v1::FEATURE_PLANE;
  const auto kind =
      plane ? std::optional(ObservationKind::kPlane) : KindFor(SightOf(feature.kind), observe);
  if (!kind || (plane && observe != v1::OBSERVE_UNSPECIFIED)) return;
  Observation contact;
  contact.reading.kind = *kind;
  contact.reading.contact = true;
  contact.reading.covariance = feature.covariance;
  SetPose(feature.X_M, &contact.reading);
  out->push_back(std::move(contact));
}

void SetCoordinates(const std::string& coordinates, Reading* reading) {
  for (size_t i = 0; i < 3; ++i)
    reading->coordinates[i] = coordinates.find("xyz"[i]) != std::string::npos;
}

void AddPosition(const v1::Reading& row, v1::Observe observe, std::vector<Observation>* out) {
  if (!row.has_position_m()) return;
  const bool some = !row.coordinates().empty();
  const auto kind =
      some ? std::optional(ObservationKind::kCoordinates) : KindFor(SightOf(row), observe);
  if (!kind || (some && observe != v1::OBSERVE_UNSPECIFIED)) return;
  Observation seen;
  seen.reading.kind = *kind;
  seen.reading.X_MT.p = VectorFrom(row.position_m());
  if (row.has_orientation()) {
    seen.reading.X_MT.R = RotationFrom(row.orientation());
    seen.reading.axis_M = seen.reading.X_MT.R.col(2);
  }
  if (row.has_axis()) seen.reading.axis_M = VectorFrom(row.axis()).normalized();
  if (row.has_position_sd_m()) seen.reading.position_sd_m = VectorFrom(row.position_sd_m());
  if (some) SetCoordinates(row.coordinates(), &seen.reading);
  out->push_back(std::move(seen));
}

void AddPoints(const v1::Reading& row, v1::Observe observe, std::vector<Observation>* out) {
  if (!KindFor(Sight::kPoint, observe)) return;
  for (const v1::MeasuredPoint& point : row.points()) {
    Observation seen;
    seen.point = point.target();
    seen.reading.kind = ObservationKind::kPoint;
    seen.reading.X_MT.p = VectorFrom(point.position_m());
    if (point.has_position_sd_m()) seen.reading.position_sd_m = VectorFrom(point.position_sd_m());
    out->push_back(std::move(seen));
  }
}

// Distances leave turns of M about their points free, as contacts do.
void AddDistance(const v1::Reading& row, const FeaturePlaces& places, v1::Observe observe,
                 std::vector<Observation>* out) {
  if (!row.has_distance_m() || observe != v1::OBSERVE_UNSPECIFIED) return;
  Observation seen;
  seen.beam = row.beam();
  seen.reading.kind = ObservationKind::kDistance;
  seen.reading.contact = true;
  seen.reading.distance_m = row.distance_m();
  seen.reading.position_sd_m.setConstant(row.distance_sd_m());
  const auto place = places.find(row.anchor());
  if (place == places.end()) {
    seen.anchor = row.anchor();
  } else {
    seen.reading.anchor_M = place->second.X_M.p;
    // Of the anchor's place only what lies along the line counts, as of the target's.
    if (place->second.covariance) {
      seen.reading.covariance = Eigen::Matrix<double, 6, 6>::Zero();
      seen.reading.covariance->topLeftCorner<3, 3>() =
          place->second.covariance->topLeftCorner<3, 3>();
    }
  }
  out->push_back(std::move(seen));
}

}  // namespace

std::vector<Observation> ObservationsOf(const v1::Reading& row, const FeaturePlace* feature,
                                        const FeaturePlaces& places, v1::Observe observe) {
  std::vector<Observation> observations;
  if (feature != nullptr) {
    AddContact(*feature, observe, &observations);
  } else {
    AddPosition(row, observe, &observations);
  }
  AddPoints(row, observe, &observations);
  AddDistance(row, places, observe, &observations);
  return observations;
}

}  // namespace truepose::convert
