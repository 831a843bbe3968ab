#include "core/models/incremental_form.h"

#include <numbers>
#include <string>

#include "absl/strings/str_cat.h"

namespace truepose {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;

// Builds the chain from base to flange.
class Builder {
 public:
  Builder(const Robot& robot, ModelExtent extent, const IncrementalForm& form, Model* model)
      : robot_(robot), extent_(extent), form_(form), model_(*model) {}

  void Run() {
    for (const ElementaryTransform& element : robot_.chain()) {
      if (element.joint < 0) {
        model_.chain.push_back(element);
      } else {
        AppendJoint(element);
      }
    }
    if (extent_ == ModelExtent::kComplete) AppendGripperErrors();
    NumberTilts();
  }

 private:
  void AppendJoint(ElementaryTransform element) {
    const Axis axis = element.axis;
    TurnZTo(axis, +1);
    if (element.joint > 0 || extent_ == ModelExtent::kComplete) AppendAxisErrors(element.joint);
    element.axis = Axis::kZ;
    if (form_.joint_offsets)
      element.parameter = Add("dq", element.joint + 1, ParameterRole::kJointOffset,
                              element.motion == Motion::kRotation);
    model_.chain.push_back(element);
    TurnZTo(axis, -1);
  }

  // The constant rotation that carries z to u (sign +1), or its inverse.
  void TurnZTo(Axis u, int sign) {
    if (u == Axis::kX) model_.chain.push_back(Rotation(Axis::kY, sign * kQuarterTurn));
    if (u == Axis::kY) model_.chain.push_back(Rotation(Axis::kX, -sign * kQuarterTurn));
  }

  // B_i, the errors of the axis of joint i+1 (index i counts joints from 0).
  void AppendAxisErrors(int i) {
    const bool has_lengths = robot_.joints()[i].type == JointType::kRevolute;
    if (form_.axis_errors == AxisErrors::kTilt) {
      if (has_lengths) AppendAxisLengths(i);
      AppendTilt(i);
    } else {
      AppendError("dalpha", i, Motion::kRotation, Axis::kX);
      AppendError("dbeta", i, Motion::kRotation, Axis::kY);
      if (has_lengths) AppendAxisLengths(i);
    }
  }

  void AppendAxisLengths(int i) {
    AppendError("da", i, Motion::kTranslation, Axis::kX);
    AppendError("db", i, Motion::kTranslation, Axis::kY);
  }

  // R(x, alpha) R(y, beta) R(z, gamma) of Eq. 23; gamma gets its number when all others have one.
  void AppendTilt(int i) {
    const int theta_x = Add("dthetax", i, ParameterRole::kAngle, true),
              theta_y = Add("dthetay", i, ParameterRole::kAngle, true);
    model_.chain.push_back({Motion::kRotation, Axis::kX, 0.0, -1, theta_y});
    model_.chain.push_back({Motion::kRotation, Axis::kY, 0.0, -1, theta_x});
    model_.chain.push_back({Motion::kRotation, Axis::kZ, 0.0, -1, -1});
    model_.tilts.push_back({theta_x, theta_y, static_cast<int>(model_.chain.size()) - 1});
  }

  // Until here a tilt's gamma was the place of its element in the chain.
  void NumberTilts() {
    int next = model_.parameters.size();
    for (Tilt& tilt : model_.tilts) {
      model_.chain[tilt.gamma].parameter = next;
      tilt.gamma = next++;
    }
  }

  // C of Eq. 22.
  void AppendGripperErrors() {
    const int n = robot_.joint_count();
    AppendError("dalpha", n, Motion::kRotation, Axis::kX);
    AppendError("dbeta", n, Motion::kRotation, Axis::kY);
    AppendError("dgamma", n, Motion::kRotation, Axis::kZ);
    AppendError("da", n, Motion::kTranslation, Axis::kX);
    AppendError("db", n, Motion::kTranslation, Axis::kY);
    AppendError("dc", n, Motion::kTranslation, Axis::kZ);
  }

  void AppendError(const std::string& stem, int link, Motion motion, Axis axis) {
    const bool angle = motion == Motion::kRotation;
    const int parameter =
        Add(stem, link, angle ? ParameterRole::kAngle : ParameterRole::kLength, angle);
    model_.chain.push_back({motion, axis, 0.0, -1, parameter});
  }

  int Add(const std::string& stem, int link, ParameterRole role, bool is_angle) {
    return model_.parameters.Add({absl::StrCat(stem, link), ParameterGroup::kInternal, role,
                                  is_angle ? Unit::kRadian : Unit::kMetre});
  }

  const Robot& robot_;
  const ModelExtent extent_;
  const IncrementalForm form_;
  Model& model_;
};

}  // namespace

Model BuildIncremental(const Robot& robot, ModelExtent extent, const IncrementalForm& form) {
  Model model;
  model.joint_map = robot.joint_map();
  Builder(robot, extent, form, &model).Run();
  return model;
}

}  // namespace truepose
