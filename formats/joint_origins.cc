#include "formats/joint_origins.h"

#include "core/base/fault.h"
#include "formats/strings.h"

namespace truepose::formats {
namespace {

using Element = v1::ElementaryTransform;

// 1 to 6 in the order of an origin.
int PlaceOf(const Element& element) {
  return element.motion() == Element::TRANSLATION ? element.axis() : 7 - element.axis();
}

double& ValueAt(int place, JointOrigin& origin) {
  switch (place) {
    case 1:
      return origin.x;
    case 2:
      return origin.y;
    case 3:
      return origin.z;
    case 4:
      return origin.yaw;
    case 5:
      return origin.pitch;
    default:
      return origin.roll;
  }
}

bool IsPlainJoint(const Element& element) {
  return element.has_joint() && element.axis() == v1::Z && element.constant() == 0;
}

// The next constants belong to an origin as long as their places ascend.
class OriginReader {
 public:
  bool Add(const Element& element) {
    if (IsPlainJoint(element)) return EndOrigin();
    const int place = PlaceOf(element);
    if (element.has_joint() || place <= last_place_) return false;
    last_place_ = place;
    ValueAt(place, origins_.back()) = element.constant();
    return true;
  }
  const std::vector<JointOrigin>& origins() const { return origins_; }

 private:
  bool EndOrigin() {
    origins_.emplace_back();
    last_place_ = 0;
    return true;
  }

  std::vector<JointOrigin> origins_ = {JointOrigin()};
  int last_place_ = 0;
};

}  // namespace

void AppendConstant(Element::Motion motion, v1::Axis axis, double constant, Elements* elements) {
  if (constant == 0) return;
  Element* element = elements->Add();
  element->set_motion(motion);
  element->set_axis(axis);
  element->set_constant(constant);
}

void AppendOrigin(const JointOrigin& origin, Elements* elements) {
  AppendConstant(Element::TRANSLATION, v1::X, origin.x, elements);
  AppendConstant(Element::TRANSLATION, v1::Y, origin.y, elements);
  AppendConstant(Element::TRANSLATION, v1::Z, origin.z, elements);
  AppendConstant(Element::ROTATION, v1::Z, origin.yaw, elements);
  AppendConstant(Element::ROTATION, v1::Y, origin.pitch, elements);
  AppendConstant(Element::ROTATION, v1::X, origin.roll, elements);
}

void AppendJoint(v1::JointType type, int joint, Elements* elements) {
  Element* element = elements->Add();
  element->set_motion(type == v1::PRISMATIC ? Element::TRANSLATION : Element::ROTATION);
  element->set_axis(v1::Z);
  element->set_joint(joint);
}

absl::StatusOr<std::vector<JointOrigin>> JointOriginsOf(const v1::Geometry& geometry) {
  OriginReader reader;
  bool fits = geometry.has_chain();
  for (const auto* elements : {&geometry.chain().elements(), &geometry.flange()}) {
    for (const Element& element : *elements) fits = fits && reader.Add(element);
  }
  if (fits) return reader.origins();
  return FaultStatus("geometry", "another form of geometry",
                     "a chain of an origin (tx ty tz rz ry rx) and an rz or tz joint, again and "
                     "again");
}

}  // namespace truepose::formats
