#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "core/identification/identifiability.h"

namespace truepose {
namespace {

// A coefficient is unit of the dropped one by unit of the kept one; mm where one of the two is a
// length.
std::string Term(const Parameter& dropped, const Parameter& kept, double c) {
  if (dropped.is_angle() == kept.is_angle()) return absl::StrFormat("%+.6g %s", c, kept.name);
  if (dropped.is_angle()) return absl::StrFormat("%+.6g mm/rad %s", 1e3 * c, kept.name);
  return absl::StrFormat("%+.6g rad/mm %s", 1e-3 * c, kept.name);
}

bool IsExternal(const ParameterSet& candidates, const std::pair<int, double>& term) {
  return candidates[term.first].group != ParameterGroup::kInternal;
}

std::string FrameOf(const Parameter& parameter) {
  return parameter.name.substr(0, parameter.name.rfind('.'));
}

std::string FrameName(const Parameter& parameter) { return FrameOf(parameter) + " frame"; }

// "a motion of the base frame", once for each frame that takes part.
std::vector<std::string> FrameTerms(const NullRelation& relation, const ParameterSet& candidates) {
  std::vector<std::string> names;
  for (const auto& term : relation.kept) {
    if (!IsExternal(candidates, term)) continue;
    const std::string name = "a motion of the " + FrameName(candidates[term.first]);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

// The motion of a base frame that shows nowhere: rates of (x, y, z, rx, ry, rz).
std::optional<Eigen::Matrix<double, kFrameParameters, 1>> HiddenMotion(
    const NullRelation& relation, const ParameterSet& candidates) {
  const Parameter& dropped = candidates[relation.dropped];
  if (dropped.group != ParameterGroup::kBase || relation.undetermined ||
      (relation.kept.empty() && !relation.of_sockets))
    return std::nullopt;
  Eigen::Matrix<double, kFrameParameters, 1> motion =
      Eigen::Matrix<double, kFrameParameters, 1>::Zero();
  motion(CorrectionOf(dropped)) = 1;
  for (const auto& [kept, c] : relation.kept) {
    if (FrameName(candidates[kept]) != FrameName(dropped)) return std::nullopt;
    motion(CorrectionOf(candidates[kept])) -= c;
  }
  return motion;
}

std::string DirectionText(const Eigen::Vector3d& v) {
  Eigen::Vector3d u = v.normalized();
  u = (u.array().abs() < 1e-6).select(0, u);
  return absl::StrFormat("(%.4g, %.4g, %.4g)", u.x(), u.y(), u.z());
}

// A turn about a line has no velocity along it at the frame's origin, nor anywhere.
std::string MotionText(const NullRelation& relation, const ParameterSet& candidates) {
  const auto motion = HiddenMotion(relation, candidates);
  if (!motion) return "";
  const Eigen::Vector3d v = motion->head<3>(), w = motion->tail<3>();
  const std::string frame = FrameOf(candidates[relation.dropped]);
  if (w.isZero()) return absl::StrCat("shift of ", frame, " along ", DirectionText(v));
  const bool turn = std::abs(v.dot(w)) < 1e-6 * w.squaredNorm();
  return absl::StrCat(turn ? "turn of " : "screw motion of ", frame, " about ",
                      relation.of_sockets ? "the line of its sockets" : "a line", ", along ",
                      DirectionText(w));
}

// Coefficients this near to 1 are 1: a basis at generic poses leaves about 1e-12 of rounding.
constexpr double kOne = 1e-9;

bool ActsAlike(const NullRelation& relation, const ParameterSet& candidates) {
  return relation.kept.size() == 1 && !IsExternal(candidates, relation.kept[0]) &&
         std::abs(relation.kept[0].second - 1) < kOne;
}

}  // namespace

std::string RelationText(const NullRelation& relation, const ParameterSet& candidates) {
  const Parameter& dropped = candidates[relation.dropped];
  if (relation.undetermined) return absl::StrCat(dropped.name, " = too weak to be told");
  if (const std::string motion = MotionText(relation, candidates); !motion.empty())
    return absl::StrCat(dropped.name, " = not observable: ", motion);
  if (relation.kept.empty()) return absl::StrCat(dropped.name, " = no effect");
  std::vector<std::string> terms = FrameTerms(relation, candidates);
  for (const auto& term : relation.kept) {
    if (!IsExternal(candidates, term))
      terms.push_back(Term(dropped, candidates[term.first], term.second));
  }
  return absl::StrCat(dropped.name, " = ", absl::StrJoin(terms, " and "));
}

std::string DroppedText(const NullRelation& relation, const ParameterSet& candidates) {
  const std::string& name = candidates[relation.dropped].name;
  const std::string left = ActsAlike(relation, candidates)
                               ? absl::StrCat(candidates[relation.kept[0].first].name, " = ", name)
                               : RelationText(relation, candidates);
  return absl::StrCat(left, ": dropped ", name);
}

std::string ReasonText(const NullRelation& relation, const ParameterSet& candidates) {
  const std::string& name = candidates[relation.dropped].name;
  const std::string always = relation.structural ? "at any poses" : "at these poses";
  if (relation.undetermined) {
    return absl::StrCat(name, " is known too weakly from these readings; it stays at nominal");
  }
  if (const std::string motion = MotionText(relation, candidates); !motion.empty())
    return absl::StrCat(motion, ": not observable ", always, "; ", name, " stays where it started");
  if (relation.kept.empty())
    return absl::StrCat(name, " does not show in this measurement ", always);
  if (ActsAlike(relation, candidates))
    return absl::StrCat(DroppedText(relation, candidates), ", ", always);
  const std::vector<std::string> frames = FrameTerms(relation, candidates);
  const bool only_frames = std::all_of(relation.kept.begin(), relation.kept.end(),
                                       [&](const auto& t) { return IsExternal(candidates, t); });
  if (only_frames) {
    return absl::StrCat(name, " can't be told from ", absl::StrJoin(frames, " and "), " ", always,
                        "; that frame takes it up");
  }
  return absl::StrCat(name, " can't be told from the parameters that it equals ", always,
                      "; they take it up");
}

}  // namespace truepose
