#include "core/drift/drift_parts.h"

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

}  // namespace truepose
