#include "core/measurement/frame.h"

#include <algorithm>
#include <array>

#include "absl/strings/str_cat.h"
#include "core/chain/chain.h"

namespace truepose {
namespace {

constexpr std::array<ElementaryTransform, kFrameParameters> kCorrections = {{
    {Motion::kTranslation, Axis::kX, 0, -1, 0},
    {Motion::kTranslation, Axis::kY, 0, -1, 1},
    {Motion::kTranslation, Axis::kZ, 0, -1, 2},
    {Motion::kRotation, Axis::kX, 0, -1, 3},
    {Motion::kRotation, Axis::kY, 0, -1, 4},
    {Motion::kRotation, Axis::kZ, 0, -1, 5},
}};

constexpr std::array<const char*, kFrameParameters> kNames = {"x", "y", "z", "rx", "ry", "rz"};

}  // namespace

Pose Corrected(const Pose& X, const double* d, FrameJacobian* J) {
  Pose result{Eigen::Matrix3d::Identity(), X.p};
  for (int i = 0; i < kFrameParameters; ++i) {
    const ElementaryTransform& element = kCorrections[i];
    if (J != nullptr) J->col(i) = ScrewOf(element, result);
    Apply(element.motion, element.axis, d[i], &result);
  }
  result.R = result.R * X.R;
  return result;
}

Parameter FrameParameter(ParameterGroup group, std::string_view label, int index) {
  const std::string frame = group == ParameterGroup::kBase ? "base" : "tool";
  const std::string owner =
      label.empty() ? frame : absl::StrCat(frame, "[", std::string(label), "]");
  return {absl::StrCat(owner, ".", kNames[index]), group, ParameterRole::kExternal,
          index >= 3 ? Unit::kRadian : Unit::kMetre};
}

int CorrectionOf(const Parameter& parameter) {
  const std::string end = parameter.name.substr(parameter.name.rfind('.') + 1);
  return static_cast<int>(std::find(kNames.begin(), kNames.end(), end) - kNames.begin());
}

}  // namespace truepose
