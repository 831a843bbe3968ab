#include "core/reproduce/measuring_robot.h"

#include <numbers>
#include <utility>

namespace truepose {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;

struct Link {
  double theta = 0, d = 0, a = 0, alpha = 0;
};
// Eq. 37's nominal values, a_2 and alpha_2 in their right places.
constexpr Link kLinks[kMeasuringRobotJoints] = {{0, .252, 0, kQuarterTurn},
                                                {0, 0, .320, 0},
                                                {kQuarterTurn, 0, 0, kQuarterTurn},
                                                {0, .330, 0, kQuarterTurn},
                                                {-kQuarterTurn, 0, 0, kQuarterTurn}};
constexpr double kPinLength = .161;

class Builder {
 public:
  explicit Builder(Model* model) : model_(*model) {}

  void Run() {
    Append("X0", Motion::kTranslation, Axis::kX, 0);
    Append("Y0", Motion::kTranslation, Axis::kY, 0);
    Append("chi0", Motion::kRotation, Axis::kX, 0);
    Append("psi0", Motion::kRotation, Axis::kY, 0);
    for (int joint = 0; joint < kMeasuringRobotJoints; ++joint) AppendLink(joint);
    Append("Zp", Motion::kTranslation, Axis::kZ, kPinLength);
  }

 private:
  void AppendLink(int joint) {
    const Link& link = kLinks[joint];
    const std::string number = std::to_string(joint + 1);
    const bool parallel_to_next = joint == 1;
    Append("th" + number, Motion::kRotation, Axis::kZ, link.theta, joint);
    if (!parallel_to_next) Append("d" + number, Motion::kTranslation, Axis::kZ, link.d);
    Append("a" + number, Motion::kTranslation, Axis::kX, link.a);
    Append("al" + number, Motion::kRotation, Axis::kX, link.alpha);
    if (parallel_to_next) Append("y" + number, Motion::kRotation, Axis::kY, 0);
  }

  void Append(const std::string& name, Motion motion, Axis axis, double constant, int joint = -1) {
    const bool angle = motion == Motion::kRotation;
    const ParameterRole role = joint >= 0 ? ParameterRole::kJointOffset
                               : angle    ? ParameterRole::kAngle
                                          : ParameterRole::kLength;
    const int parameter = model_.parameters.Add(
        {name, ParameterGroup::kInternal, role, angle ? Unit::kRadian : Unit::kMetre});
    model_.chain.push_back({motion, axis, constant, joint, parameter});
  }

  Model& model_;
};

}  // namespace

Model MeasuringRobot() {
  Model model;
  model.kind = "measuring_robot";
  model.convention = "measuring_robot/1: Eqs. 33 to 36, d2 held";
  model.joint_map = JointMap::Identity(kMeasuringRobotJoints);
  Builder(&model).Run();
  return model;
}

const std::vector<std::string>& ReducedSet() {
  static const auto* const kNames = new std::vector<std::string>{
      "X0", "Y0", "chi0", "psi0", "th1", "d1", "th2", "a2", "th3", "th4", "d4", "th5", "d5", "Zp"};
  return *kNames;
}

const std::vector<std::string>& AdditionalSet() {
  static const auto* const kNames = new std::vector<std::string>{
      "a1", "al1", "al2", "y2", "d3", "a3", "al3", "a4", "al4", "a5", "al5"};
  return *kNames;
}

Problem MeasuringRobotProblem(const Model& model, std::vector<Reading> readings) {
  return {&model, std::move(readings), {""}, {""}};
}

std::vector<int> CandidatesNamed(const Problem& problem, const std::vector<std::string>& names) {
  std::vector<int> candidates;
  for (const std::string& name : names)
    candidates.push_back(problem.FirstInternal() + problem.model->parameters.Find(name).value());
  return candidates;
}

}  // namespace truepose
