#include "core/drift/drift_parts.h"

#include <cmath>

#include "absl/strings/str_cat.h"

namespace truepose {
namespace {

void AddFrame(int first, std::vector<int>* candidates) {
  for (int i = 0; i < kFrameParameters; ++i) candidates->push_back(first + i);
}

std::vector<int> Frames(const DriftProblem& problem, bool held, bool bases, bool tools) {
  std::vector<int> candidates;
  for (int i = 0; bases && i < problem.check.placement_count(); ++i)
    if (problem.base_held[i] == held) AddFrame(problem.check.FirstOfBase(i), &candidates);
  for (int i = 0; tools && i < problem.check.target_count(); ++i)
    if (problem.tool_held[i] == held) AddFrame(problem.check.FirstOfTool(i), &candidates);
  return candidates;
}

// Whether controller joint j moves chain joint i and no other.
bool MovesOnly(const Robot& robot, int j, int i) {
  Eigen::VectorXd column = robot.joint_map().scale.col(j);
  column(i) = 0;
  return column.isZero(0);
}

// The largest motion among the frames of a part: six changes each.
void FrameChange(const Eigen::VectorXd& changes, DriftPart* part) {
  for (Eigen::Index i = 0; i + kFrameParameters <= changes.size(); i += kFrameParameters) {
    const double length = changes.segment<3>(i).norm(), angle = changes.segment<3>(i + 3).norm();
    if (length + angle <= part->change_m + part->change_rad) continue;
    part->change_m = length;
    part->change_rad = angle;
  }
}

}  // namespace

std::vector<CandidatePart> PartsOf(const DriftProblem& problem) {
  std::vector<CandidatePart> parts;
  const std::vector<int> bases = Frames(problem, true, true, false),
                         tools = Frames(problem, true, false, true);
  if (!bases.empty()) parts.push_back({CandidatePart::Kind::kBase, "base or joint 1", {bases, {}}});
  const int n = problem.robot->joint_count();
  for (int j = 0; j < n; ++j) {
    if (MovesOnly(*problem.robot, j, 0) || MovesOnly(*problem.robot, j, n - 1)) continue;
    parts.push_back({CandidatePart::Kind::kJoint, absl::StrCat("joint ", j + 1), {{}, {j}}});
  }
  if (!tools.empty())
    parts.push_back({CandidatePart::Kind::kTool, "tool or last joint", {tools, {}}});
  return parts;
}

Freedom LegitimateChanges(const DriftProblem& problem) {
  Freedom freedom{Frames(problem, false, true, true), {}};
  for (size_t i = 0; i < problem.check.offsets.size(); ++i)
    freedom.candidates.push_back(problem.check.FirstOfOffsets() + static_cast<int>(i));
  return freedom;
}

void SetChange(const DriftProblem& problem, const CandidatePart& candidate,
               const Eigen::VectorXd& frames, const Eigen::VectorXd& joints, DriftPart* part) {
  if (candidate.kind != CandidatePart::Kind::kJoint) return FrameChange(frames, part);
  const int joint = candidate.freedom.joints[0];
  const bool turns =
      problem.robot->joints()[static_cast<size_t>(joint)].type == JointType::kRevolute;
  (turns ? part->change_rad : part->change_m) = std::abs(joints(joint));
}

}  // namespace truepose
