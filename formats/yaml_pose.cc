#include "formats/yaml_pose.h"

#include <array>
#include <string_view>

#include "formats/number.h"
#include "formats/strings.h"

namespace truepose::formats {

std::optional<QuaternionArray> FindQuaternion(YamlMap& map) {
  constexpr std::array<std::string_view, 4> kKeys = {"qx", "qy", "qz", "qw"};
  QuaternionArray q = {0, 0, 0, 1};
  size_t found = 0, there = 0;
  for (size_t i = 0; i < kKeys.size(); ++i) {
    there += map.Find(kKeys[i]) != nullptr;
    const auto number = map.FindNumber(kKeys[i]);
    if (!number) continue;
    ++found;
    q[i] = number->value;
  }
  if (there != 0 && there != kKeys.size()) {
    map.faults().Add(map.node().line, map.path(), StrCat(there, " of qx, qy, qz, qw"),
                     "all four or none");
  }
  if (found != there || (there != 0 && there != kKeys.size())) return std::nullopt;
  if (NormaliseRounded(q)) return q;
  map.faults().Add(map.node().line, StrCat(map.path(), ".qx,qy,qz,qw"),
                   StrCat("a length of ", FormatNumber(Length(q))), "1 within 0.001");
  return std::nullopt;
}

void SetRotation(QuaternionArray q, v1::Pose* pose) {
  const double sign = q[3] < 0 ? -1 : 1;
  pose->set_qx(sign * q[0]);
  pose->set_qy(sign * q[1]);
  pose->set_qz(sign * q[2]);
  pose->set_qw(sign * q[3]);
}

}  // namespace truepose::formats
