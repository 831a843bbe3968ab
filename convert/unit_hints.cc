#include "convert/unit_hints.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "convert/frames.h"

namespace truepose::convert {
namespace {

constexpr double kMostRadians = 4 * std::numbers::pi;
constexpr double kFactor = 100;
constexpr double kLeastFlangeSpan_m = 0.01;

const google::protobuf::RepeatedField<double>& JointsOf(const v1::Reading& reading) {
  return reading.joints_measured().empty() ? reading.joints_commanded() : reading.joints_measured();
}

void HintAtJoints(const v1::Nominal& nominal, const v1::SessionInput& session,
                  std::vector<std::string>* hints) {
  for (int j = 0; j < nominal.joints_size(); ++j) {
    if (nominal.joints(j).type() == v1::PRISMATIC) continue;
    double most = 0;
    for (const v1::Reading& reading : session.readings())
      if (j < JointsOf(reading).size()) most = std::max(most, std::abs(JointsOf(reading)[j]));
    if (most <= kMostRadians) continue;
    hints->push_back(absl::StrFormat(
        "joint %s is read at up to %.3g rad, beyond two turns: are these degrees (q%d_deg)?",
        nominal.joints(j).name(), most, j + 1));
    return;  // one joint stands for all
  }
}

// Larger side of the bounding box of points.
class Extent {
 public:
  void Add(const Eigen::Vector3d& p) {
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
  }
  double Span() const { return std::max(0.0, (high_ - low_).maxCoeff()); }

 private:
  Eigen::Vector3d low_ = Eigen::Vector3d::Constant(HUGE_VAL);
  Eigen::Vector3d high_ = Eigen::Vector3d::Constant(-HUGE_VAL);
};

void HintAtPositions(const Robot& robot, const v1::SessionInput& session,
                     std::vector<std::string>* hints) {
  Extent measured, flange;
  double reach = 0;
  for (const v1::Reading& reading : session.readings()) {
    const auto& joints = JointsOf(reading);
    if (!reading.has_position_m() || !reading.coordinates().empty() || joints.empty()) continue;
    const Eigen::Map<const Eigen::VectorXd> q(joints.data(), joints.size());
    const Eigen::Vector3d p =
        Forward(robot.chain(), robot.joint_map().ToChain(q), Eigen::VectorXd()).p;
    reach = std::max(reach, p.norm());
    measured.Add(VectorFrom(reading.position_m()));
    flange.Add(p);
  }
  const double span = measured.Span();
  if (flange.Span() < kLeastFlangeSpan_m) return;
  const bool small = span < flange.Span() / kFactor;
  if (!small && span <= flange.Span() * kFactor) return;
  hints->push_back(absl::StrFormat(
      "positions span %.3g mm, the arm reaches %.4g mm at these joints: are they %s?", 1e3 * span,
      1e3 * reach, small ? "metres (x_m)" : "millimetres (x_mm)"));
}

}  // namespace

std::vector<std::string> UnitHints(const v1::Nominal& nominal, const Robot& robot,
                                   const v1::SessionInput& session) {
  std::vector<std::string> hints;
  HintAtJoints(nominal, session, &hints);
  // Degrees taken for radians scatter the flange over all its reach: no ground to judge from.
  if (hints.empty()) HintAtPositions(robot, session, &hints);
  return hints;
}

}  // namespace truepose::convert
