#include "client/cli/configuration_changes.h"

#include <cmath>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "client/cli/table.h"

namespace truepose::cli {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kTurned = std::numbers::pi / 2;
// Poses nearer than this are neighbours on a path, between which no joint turns so far by itself.
constexpr double kNear_m = 0.25, kNear_rad = std::numbers::pi / 4;

struct Change {
  int row = -1, joint = -1;
  double angle = 0;
};

Change LargestTurn(const v1::Nominal& nominal, const v1::CompensatedTarget& from,
                   const v1::CompensatedTarget& to) {
  Change largest;
  for (int j = 0; j < to.joints_size(); ++j) {
    const double angle = std::abs(to.joints(j) - from.joints(j));
    if (nominal.joints(j).type() != v1::REVOLUTE || angle <= largest.angle) continue;
    largest = {to.row(), j, angle};
  }
  return largest;
}

bool AreNear(const v1::Pose& a, const v1::Pose& b) {
  const double distance = std::hypot(a.x_m() - b.x_m(), a.y_m() - b.y_m(), a.z_m() - b.z_m());
  const double cosine =
      std::abs(a.qx() * b.qx() + a.qy() * b.qy() + a.qz() * b.qz() + a.qw() * b.qw());
  return distance < kNear_m && cosine > std::cos(kNear_rad / 2);
}

bool IsOnAPath(const v1::CompensationTarget& target) {
  return target.has_pose() && target.joints().empty();
}

}  // namespace

void WarnOfConfigurationChanges(const Console& console, const v1::Nominal& nominal,
                                const v1::CompensateRequest& request,
                                const v1::CompensateResponse& response) {
  int changes = 0;
  Change first;
  const v1::CompensatedTarget* before = nullptr;
  for (int i = 0; i < response.targets_size() && i < request.targets_size(); ++i) {
    const v1::CompensatedTarget& target = response.targets(i);
    if (target.joints().empty()) continue;
    if (before != nullptr && IsOnAPath(request.targets(i)) &&
        AreNear(before->pose(), target.pose())) {
      const Change change = LargestTurn(nominal, *before, target);
      if (change.angle > kTurned && changes++ == 0) first = change;
    }
    before = &target;
  }
  if (changes == 0) return;
  Warn(console,
       absl::StrCat("the arm turns over ", Count(changes, "time"),
                    " on this path; first before target ", first.row, ", where joint ",
                    nominal.joints(first.joint).name(), " turns by ",
                    Fixed(kDegPerRad * first.angle, 0),
                    " deg: it can't be followed in one configuration; give the poses joints, or "
                    "move the path"));
}

}  // namespace truepose::cli
