#include "client/cli/large_changes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "absl/strings/str_cat.h"
#include "client/cli/table.h"
#include "programs/correct.h"

namespace truepose::cli {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

bool Slides(const v1::Nominal& nominal, int joint) {
  return nominal.joints(joint).type() == v1::PRISMATIC;
}

double LargestOf(const v1::Nominal& nominal, int joint) {
  const programs::CorrectOptions program;
  return Slides(nominal, joint) ? program.largest_change_m : program.largest_change_rad;
}

double ChangeOf(const v1::CompensationTarget& asked, const v1::CompensatedTarget& corrected,
                int joint) {
  return std::abs(corrected.joints(joint) - asked.joints(joint));
}

// The joint that changes by the most times what it may; -1 where none changes by more.
int WorstJoint(const v1::Nominal& nominal, const v1::CompensationTarget& asked,
               const v1::CompensatedTarget& corrected) {
  if (asked.has_pose() || asked.joints_size() != corrected.joints_size()) return -1;
  int worst = -1;
  double most = 1;
  for (int j = 0; j < asked.joints_size(); ++j) {
    const double times = ChangeOf(asked, corrected, j) / LargestOf(nominal, j);
    if (times > most) worst = j;
    most = std::max(most, times);
  }
  return worst;
}

std::string LengthOf(const v1::Nominal& nominal, int joint, double value) {
  return Slides(nominal, joint) ? Fixed(1e3 * value, 1) + " mm"
                                : Fixed(kDegPerRad * value, 1) + " deg";
}

std::string Text(const v1::Nominal& nominal, int targets, const v1::CompensationTarget& asked,
                 const v1::CompensatedTarget& corrected, int joint) {
  return absl::StrCat(
      Count(targets, "target"), " with a joint that changes by more than ",
      LengthOf(nominal, joint, LargestOf(nominal, joint)), "; the first is target ",
      corrected.row(), ", q", joint + 1, " by ",
      LengthOf(nominal, joint, ChangeOf(asked, corrected, joint)),
      ": near a singularity, or its numbers are in other units than their columns say");
}

}  // namespace

void WarnOfLargeChanges(const Console& console, const v1::Nominal& nominal,
                        const v1::CompensateRequest& request,
                        const v1::CompensateResponse& response) {
  int targets = 0, first = -1, joint = -1;
  for (int i = 0; i < std::min(request.targets_size(), response.targets_size()); ++i) {
    const int worst = WorstJoint(nominal, request.targets(i), response.targets(i));
    if (worst < 0) continue;
    if (targets++ == 0) first = i, joint = worst;
  }
  if (targets == 0) return;
  Warn(console, Text(nominal, targets, request.targets(first), response.targets(first), joint));
}

}  // namespace truepose::cli
