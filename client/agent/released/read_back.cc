#include "client/agent/released/read_back.h"

#include <algorithm>
#include <cmath>

#include "compensation/kinematics.h"

namespace truepose::agent {
namespace {

constexpr double kExcluded = 25;
constexpr double kDeviations = 4;
constexpr int kMostPoses = 200;  // beyond it more of the same is no way

struct Hypothesis {
  std::string parameters, state;
  std::vector<Pose> X_BF;  // at each pose's joints
};

using FlangeOf = Pose (*)(const compensation::Arm&, const double*) noexcept;

Hypothesis Of(const std::string& parameters, const std::string& state, const compensation::Arm& arm,
              FlangeOf flange, const std::vector<ReportedPose>& poses) {
  Hypothesis hypothesis{parameters, state, {}};
  for (const ReportedPose& pose : poses) hypothesis.X_BF.push_back(flange(arm, pose.joints.data()));
  return hypothesis;
}

std::vector<Hypothesis> HypothesesOf(const ReleasedState& state,
                                     const std::vector<ReportedPose>& poses) {
  const ReleasedSet& current = *state.current;
  std::vector<Hypothesis> all;
  all.push_back(Of("nominal", "nominal", current.table().arm, compensation::NominalFlange, poses));
  all.push_back(Of(current.entry().calibration, "active", current.table().arm,
                   compensation::IdentifiedFlange, poses));
  for (const auto& set : state.former)
    if (set->table().header.joints == current.table().header.joints)
      all.push_back(Of(set->entry().calibration, "older", set->table().arm,
                       compensation::IdentifiedFlange, poses));
  return all;
}

FrameFit Fit(const std::vector<PosePair>& pairs, const ReadBackOptions& options) {
  return options.frames.has_value() ? ResidualsOf(pairs, options.noise, *options.frames)
                                    : FitFrames(pairs, options.noise);
}

FrameFit FitTo(const Hypothesis& hypothesis, const std::vector<ReportedPose>& poses,
               const ReadBackOptions& options) {
  std::vector<PosePair> pairs;
  for (size_t i = 0; i < poses.size(); ++i) pairs.push_back({hypothesis.X_BF[i], poses[i].X_WT});
  return Fit(pairs, options);
}

bool Fits(const FrameFit& fit) {
  const double degrees = fit.degrees_of_freedom;
  return fit.sum_of_squares <= degrees + kDeviations * std::sqrt(2 * degrees);
}

// How far apart the two are by these poses, without noise.
FrameFit Apart(const Hypothesis& a, const Hypothesis& b, const ReadBackOptions& options) {
  ReadBackOptions without = options;
  if (options.frames.has_value()) without.frames = Frames();
  std::vector<PosePair> pairs;
  for (size_t i = 0; i < a.X_BF.size(); ++i) pairs.push_back({a.X_BF[i], b.X_BF[i]});
  return Fit(pairs, without);
}

// The sum of squares grows with the degrees of freedom.
int PosesNeeded(const Hypothesis& a, const Hypothesis& b, const ReadBackOptions& options) {
  const FrameFit apart = Apart(a, b, options);
  if (apart.degrees_of_freedom <= 0) return kFewestPoses;
  const double of_one = apart.sum_of_squares / apart.degrees_of_freedom;
  if (of_one * 6 * kMostPoses < kExcluded) return kMostPoses + 1;
  const int unknowns = 6 * static_cast<int>(a.X_BF.size()) - apart.degrees_of_freedom;
  return std::max(kFewestPoses, static_cast<int>(std::ceil((kExcluded / of_one + unknowns) / 6)));
}

// Of the hypotheses in the order of their fits.
int MorePoses(const std::vector<Hypothesis>& all, const std::vector<HypothesisFit>& fits,
              const ReadBackOptions& options) {
  const auto find = [&](const HypothesisFit& fit) -> const Hypothesis& {
    return *std::find_if(all.begin(), all.end(),
                         [&](const auto& one) { return one.parameters == fit.parameters; });
  };
  const int have = static_cast<int>(all[0].X_BF.size());
  int needed = kFewestPoses;
  for (size_t i = 1; i < fits.size(); ++i)
    if (fits[i].fit.sum_of_squares - fits[0].fit.sum_of_squares < kExcluded)
      needed = std::max(needed, PosesNeeded(find(fits[0]), find(fits[i]), options));
  return needed > kMostPoses ? 0 : std::max(1, needed - have);
}

}  // namespace

ReadBackResult ReadBack(const ReleasedState& state, const std::vector<ReportedPose>& poses,
                        const ReadBackOptions& options) {
  ReadBackResult result{.controller_state = "undecided", .parameters = {}, .fits = {}};
  result.more_poses = kFewestPoses - static_cast<int>(poses.size());
  if (poses.empty()) return result;
  const std::vector<Hypothesis> all = HypothesesOf(state, poses);
  for (const Hypothesis& one : all)
    result.fits.push_back({one.parameters, one.state, FitTo(one, poses, options)});
  std::stable_sort(result.fits.begin(), result.fits.end(), [](const auto& a, const auto& b) {
    return a.fit.sum_of_squares < b.fit.sum_of_squares;
  });
  if (result.more_poses > 0) return result;
  const HypothesisFit& best = result.fits[0];
  const double least_other = result.fits[1].fit.sum_of_squares;
  result.more_poses = 0;
  if (!Fits(best.fit)) {
    result.controller_state = "unknown";
  } else if (least_other - best.fit.sum_of_squares >= kExcluded) {
    result.controller_state = best.state;
    result.parameters = best.parameters;
  } else {
    result.more_poses = MorePoses(all, result.fits, options);
  }
  return result;
}

}  // namespace truepose::agent
