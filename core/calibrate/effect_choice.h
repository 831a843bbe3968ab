// Which joint effects a session is entitled to: those that predict readings which they were not
// fitted to.
//
// Effects make a fit to few readings look better and the robot worse (a UR10 from 50 poses: 0.551
// -> 0.564 mm), so a group is taken only when
//  - there are at least `values_per_parameter` measured values for each parameter, that group's
//  included: three points, or one and a half poses, each. What a reading says is counted by its
//  values, since a pose's six settle twice as much as a point's three;
//  - the RMS of k-fold cross-validation on the calibration readings falls by more than its own
//    standard error, and by at least `least_gain`: with thousands of readings a gain of a
//    thousandth is significant and still buys nothing for the parameters that it costs. With less
//    than twice as many values it has to fall by `least_gain_of_few`: there a group that gains a
//    few hundredths by chance is taken now and then (one of 30 draws of 100 poses, control RMS
//    +7.5 %), while what a robot really lacks gains much more.
// The group that improves most is taken first, then the rest is looked at again. Folds are fitted
// on the linearised problem at the geometric solution: effects are of the size of the errors that
// it leaves, so what is neglected is of second order.
#pragma once

#include <string>
#include <vector>

#include "core/identification/identify.h"

namespace truepose {

struct EffectChoiceOptions {
  int folds = 10;
  double values_per_parameter = 9;
  double least_gain = 0.01;         // share of the cross-validated RMS
  double least_gain_of_few = 0.10;  // the same with few values
  uint64_t seed = 1;
};

// One look at one group.
struct EffectStep {
  std::string added;  // "gain"; "" is the geometric model alone
  int parameters = 0;
  double weighted_rms = 0;     // of the calibration readings, in standard deviations
  double cross_validated = 0;  // RMS of held-out readings, in standard deviations
  bool taken = false;
};

// A group that was never looked at, and why.
struct UntriedEffect {
  EffectGroup group;
  std::string reason;
  int reading_id = -1;  // Reading::id of the first reading in which its cause is missing
};

struct EffectChoice {
  std::vector<EffectGroup> groups;  // taken, in their order of taking
  std::vector<EffectStep> path;
  std::vector<UntriedEffect> untried;  // with `path` every group is named
};

// The groups that readings can carry: compliance needs torques in every reading or the robot's
// masses, temperature a temperature that varies.
std::vector<EffectGroup> AvailableEffects(const Robot& robot, const Problem& problem);
// The others, each with the cause that is missing.
std::vector<UntriedEffect> EffectsWithoutCause(const Robot& robot, const Problem& problem);

// @param problem calibration readings with a geometric model. @param geometric its identification.
EffectChoice ChooseEffects(const Robot& robot, const Problem& problem,
                           const Identification& geometric, const EffectChoiceOptions& options);

}  // namespace truepose
