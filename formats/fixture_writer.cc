#include <string>

#include "formats/feature_uncertainty.h"
#include "formats/fixture_file.h"
#include "formats/number.h"
#include "formats/strings.h"
#include "formats/unit.h"
#include "formats/yaml.h"

namespace truepose::formats {
namespace {

std::string_view NameOf(v1::FeatureKind kind) {
  if (kind == v1::FEATURE_POINT) return "point";
  if (kind == v1::FEATURE_POINT_AXIS) return "point_axis";
  return kind == v1::FEATURE_PLANE ? "plane" : "pose";
}

std::string RotationText(const v1::Feature& feature) {
  const v1::Pose& pose = feature.pose();
  if (feature.kind() == v1::FEATURE_POINT) return "";
  return StrCat(", qx: ", FormatNumber(pose.qx()), ", qy: ", FormatNumber(pose.qy()),
                ", qz: ", FormatNumber(pose.qz()), ", qw: ", FormatNumber(pose.qw()));
}

std::string FeatureText(const v1::Feature& feature) {
  const v1::Pose& pose = feature.pose();
  return StrCat("  - {name: ", YamlText(feature.name()), ", kind: ", NameOf(feature.kind()), ", ",
                EntryOfPosition("position", pose.x_m(), pose.y_m(), pose.z_m()),
                RotationText(feature), UncertaintyText(feature), "}\n");
}

}  // namespace

std::string WriteFixtureFile(const v1::Fixture& fixture) {
  std::string out = StrCat("name: ", YamlText(fixture.name()), "\nfeatures:\n");
  for (const v1::Feature& feature : fixture.features()) out += FeatureText(feature);
  return out;
}

}  // namespace truepose::formats
