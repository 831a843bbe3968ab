// Which parameters a controller runs, by poses that it reports.
//
// Each set of parameters that this PC knows is a hypothesis: the nominal ones, those of the
// released set, those of sets before it. Its X_BF at the joints is laid beside the reported poses
// (fit_frames.h), which leaves a sum of squares S over the stated noise. With n poses and d degrees
// of freedom
//   the best one fits          when S <= d + 4 sqrt(2 d)       (4 standard deviations of chi
//   square) another one is excluded    when S_other - S >= 25          (a likelihood of 5 sigma)
// Without known frames 12 unknowns are fitted, so fewer than kFewestPoses say nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/agent/released/fit_frames.h"
#include "client/agent/released/released_store.h"

namespace truepose::agent {

inline constexpr int kFewestPoses = 4;

struct ReportedPose {
  std::vector<double> joints;  // of the controller, rad or m, as many as the arm has
  Pose X_WT;
};

struct ReadBackOptions {
  PoseNoise noise;
  std::optional<Frames> frames;  // when W and T are known
};

struct HypothesisFit {
  std::string parameters;  // "nominal" or robots/{robot}/calibrations/{number}
  std::string state;       // "nominal", "active" (the released set), "older"
  FrameFit fit;
};

struct ReadBackResult {
  // That of the hypothesis; "unknown" when none fits; "undecided" when several may be.
  std::string controller_state;
  std::string parameters;  // of the hypothesis, else ""
  // Of "undecided": about how many more poses like these it takes; 0: these hypotheses are too
  // alike for that, at poses like these.
  int more_poses = 0;
  std::vector<HypothesisFit> fits;  // the best first
};

// @param state with a set. @param poses each with as many joints as the set's arm.
ReadBackResult ReadBack(const ReleasedState& state, const std::vector<ReportedPose>& poses,
                        const ReadBackOptions& options);

}  // namespace truepose::agent
