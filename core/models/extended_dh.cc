#include <cmath>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/models/dh_link.h"
#include "core/models/model.h"

namespace truepose {
namespace {

// Which elements of a link are parameters.
enum class Freed { kNone, kJointOnly, kAll };

class Builder {
 public:
  Builder(const Robot& robot, ModelExtent extent, Model* model)
      : robot_(robot), extent_(extent), model_(*model) {}

  void Run() {
    const std::vector<AxisLine> lines = WithPrismaticPlaced(robot_, AxisLines(robot_));
    const bool complete = extent_ == ModelExtent::kComplete;
    AppendLink(LinkTo({}, LinkStart::kBase, lines[0]), 0, complete ? Freed::kAll : Freed::kNone);
    const int n = robot_.joint_count();
    for (int i = 1; i < n; ++i) AppendLink(LinkTo(X_, StartOf(i), lines[i]), i, Freed::kAll);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
    const Pose X_BF = Forward<double>(robot_.chain(), zero.data(), nullptr);
    AppendLink(LastLink(robot_.joints()[n - 1].type, (Inverse(X_) * X_BF).p), n,
               complete ? Freed::kAll : Freed::kJointOnly);
    AppendRotation((Inverse(X_) * X_BF).R);
  }

 private:
  LinkStart StartOf(int i) const {
    return robot_.joints()[i - 1].type == JointType::kRevolute ? LinkStart::kRevolute
                                                               : LinkStart::kPrismatic;
  }

  void AppendLink(const Link& link, int i, Freed freed) {
    for (const LinkElement& element : link) {
      const bool free = freed == Freed::kAll || (freed == Freed::kJointOnly && element.moves);
      Append({element.motion, element.axis, element.value, element.moves ? i - 1 : -1,
              free ? Add(element, i) : -1});
    }
    X_ = After(X_, link);
  }

  int Add(const LinkElement& element, int i) {
    const bool angle = element.motion == Motion::kRotation;
    const Unit unit = angle ? Unit::kRadian : Unit::kMetre;
    if (element.moves)
      return model_.parameters.Add(
          {absl::StrCat("dq", i), ParameterGroup::kInternal, ParameterRole::kJointOffset, unit});
    return model_.parameters.Add({absl::StrCat("d", element.stem, i), ParameterGroup::kInternal,
                                  angle ? ParameterRole::kAngle : ParameterRole::kLength, unit});
  }

  // R = R(z) R(y) R(x), one axis after the other taken off, which stays exact where the angles
  // themselves are not determined.
  void AppendRotation(Eigen::Matrix3d R) {
    const double about_z = std::atan2(R(1, 0), R(0, 0));
    R = Eigen::AngleAxisd(-about_z, Eigen::Vector3d::UnitZ()).toRotationMatrix() * R;
    const double about_y = std::atan2(-R(2, 0), R(0, 0));
    R = Eigen::AngleAxisd(-about_y, Eigen::Vector3d::UnitY()).toRotationMatrix() * R;
    Append(Rotation(Axis::kZ, about_z));
    Append(Rotation(Axis::kY, about_y));
    Append(Rotation(Axis::kX, std::atan2(R(2, 1), R(1, 1))));
  }

  void Append(const ElementaryTransform& element) {
    if (element.constant == 0 && element.joint < 0 && element.parameter < 0) return;
    model_.chain.push_back(element);
  }

  const Robot& robot_;
  const ModelExtent extent_;
  Model& model_;
  Pose X_;  // frame i in B, joints at zero
};

}  // namespace

Model ExtendedDh(const Robot& robot, ModelExtent extent) {
  Model model;
  model.kind = "extended_dh";
  model.convention =
      "extended_dh/1: D&H Rz Tz Tx Rx | Hayati Rz Tx Rx Ry | PR Tz Ty Rx Ry | coincident "
      "Rz Tx Ty Rx Ry | R6 Rz Ry Rx Tz Ty Tx | P6 Tz Ty Tx Rz Ry Rx";
  model.joint_map = robot.joint_map();
  Builder(robot, extent, &model).Run();
  return model;
}

}  // namespace truepose
