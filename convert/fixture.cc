#include "convert/fixture.h"

#include <Eigen/Dense>
#include <set>

#include "absl/strings/str_cat.h"
#include "convert/frames.h"
#include "core/base/fault.h"

namespace truepose::convert {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr int kNumbers = 36;
constexpr double kRounded = 1e-9;

Matrix6 MatrixFrom(const v1::Feature& feature) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(
      feature.covariance().data());
}

// The covariance over its standard deviations, so that mm and rad weigh the same; a coordinate
// without a variance keeps its row as it is, and anything in it is then far from semidefinite.
Matrix6 Correlations(const Matrix6& covariance) {
  const Eigen::Matrix<double, 6, 1> sd = covariance.diagonal().cwiseMax(0).cwiseSqrt();
  const double largest = covariance.cwiseAbs().maxCoeff();
  Eigen::Matrix<double, 6, 1> scale;
  for (int i = 0; i < 6; ++i)
    scale(i) = sd(i) > 0 ? 1 / sd(i) : (largest > 0 ? 1 / std::sqrt(largest) : 1);
  return scale.asDiagonal() * covariance * scale.asDiagonal();
}

void CheckCovariance(const v1::Feature& feature, const std::string& field, FaultList* faults) {
  if (feature.covariance_size() == 0) return;
  if (feature.covariance_size() != kNumbers) {
    return faults->Add(field, absl::StrCat(feature.covariance_size(), " values"),
                       "none, or 36, 6 x 6 row by row");
  }
  const Matrix6 covariance = MatrixFrom(feature);
  if (!covariance.allFinite() || covariance.cwiseAbs().maxCoeff() > kLargestLength_m)
    return faults->Add(field, "a value that is not finite or far too large", "finite numbers");
  if ((covariance.diagonal().array() < 0).any())
    return faults->Add(field, "a negative variance", "a covariance");
  const Matrix6 scaled = Correlations(covariance);
  if ((scaled - scaled.transpose()).cwiseAbs().maxCoeff() > kRounded)
    return faults->Add(field, "a matrix that is not symmetric", "a covariance");
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(scaled, Eigen::EigenvaluesOnly);
  if (eigen.eigenvalues()(0) < -kRounded) {
    faults->Add(field, absl::StrCat("an eigenvalue of ", eigen.eigenvalues()(0), " (scaled)"),
                "a covariance: positive semidefinite");
  }
}

void CheckFeature(const v1::Feature& feature, const std::string& field, FaultList* faults) {
  if (feature.name().empty()) faults->Add(field + ".name", "an empty name", "a name");
  if (feature.kind() < v1::FEATURE_POSE || feature.kind() > v1::FEATURE_PLANE) {
    faults->Add(field + ".kind", absl::StrCat(static_cast<int>(feature.kind())),
                "FEATURE_POSE, FEATURE_POINT, FEATURE_POINT_AXIS or FEATURE_PLANE");
  }
  CheckPose(feature.pose(), field + ".pose", faults);
  CheckCovariance(feature, field + ".covariance", faults);
}

}  // namespace

absl::Status ValidateFixture(const v1::Fixture& fixture) {
  FaultList faults;
  std::set<std::string> names;
  for (int i = 0; i < fixture.features_size(); ++i) {
    const v1::Feature& feature = fixture.features(i);
    const std::string field = absl::StrCat("features[", i, "]");
    CheckFeature(feature, field, &faults);
    if (!names.insert(feature.name()).second) {
      faults.Add(field + ".name", absl::StrCat("'", feature.name(), "' again"),
                 "a name of its own");
    }
  }
  if (fixture.features().empty()) faults.Add("features", "none", "at least one feature");
  return faults.ToStatus();
}

FeaturePlaces FeaturePlacesOf(const v1::Fixture& fixture) {
  FeaturePlaces places;
  for (const v1::Feature& feature : fixture.features()) {
    FeaturePlace place{feature.kind(), PoseFrom(feature.pose()), std::nullopt};
    if (feature.covariance_size() == kNumbers) {
      const Matrix6 covariance = MatrixFrom(feature);
      place.covariance = (covariance + covariance.transpose()) / 2;
    }
    places.emplace(feature.name(), std::move(place));
  }
  return places;
}

}  // namespace truepose::convert
