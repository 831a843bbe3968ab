// Fixtures of messages: their faults, and their features as places in M.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "core/geometry/pose.h"
#include "truepose/v1/fixture.pb.h"

namespace truepose::convert {

struct FeaturePlace {
  v1::FeatureKind kind = v1::FEATURE_POSE;
  Pose X_M;                                               // the feature in the fixture's frame M
  std::optional<Eigen::Matrix<double, 6, 6>> covariance;  // of (position, rotation), axes of M
};

using FeaturePlaces = std::map<std::string, FeaturePlace>;

// Every fault of a fixture: no feature, a name that is empty or stands twice, no kind, a pose that
// is none, a covariance that is not 6 x 6, symmetric and positive semidefinite (to 1e-9 of its
// deviations: files round). Field paths of v1::Fixture, such as `features[2].covariance`.
absl::Status ValidateFixture(const v1::Fixture& fixture);

// By name. @param fixture one that ValidateFixture accepts.
FeaturePlaces FeaturePlacesOf(const v1::Fixture& fixture);

}  // namespace truepose::convert
