// Whether identified parameters should be applied, judged on the control set only.
#pragma once

#include <string>
#include <vector>

#include "core/assessment/statistics.h"
#include "core/identification/identify.h"
#include "core/identification/selection.h"

namespace truepose {

enum class Decision { kApply, kApplyWithinVolume, kDoNotApply };

struct Verdict {
  Decision decision = Decision::kDoNotApply;
  std::vector<std::string> reasons;  // sentences with their numbers
};

const char* Name(Decision decision);

// Paired bootstrap of the ratio of control RMS positions after / before: 2,000 draws of rows (with
// all points of a row) with replacement, fixed seed; @returns its 2.5 % and 97.5 % quantiles.
// @param before, after the same readings in the same order, not empty.
struct Interval {
  double low, high;
};
Interval BootstrapRatio(const std::vector<PoseError>& before, const std::vector<PoseError>& after);

// do_not_apply when the solver did not converge, when no internal parameter was identified, when
// that interval does not lie below 1 by more than round-off (1e-6; below 5 control rows there is no
// interval, and the ratio itself must), or when a
// correction exceeds 100 mm or 10 deg: no robot is that wrong, so joints, units or robot file are;
// nor when what stays unexplained (identify.h) exceeds 5 mm or 0.5 deg per axis: real arms leave below 1 mm, so units, joints,
// anchors or the robot file are wrong, or the start was, whatever the ratio says;
// apply_within_volume when parameters stayed nominal for want of readings, or when there are
// fewer than 10 control rows; apply otherwise. Several points of one row are one row everywhere.
// @param parameters those of the model, beside identification.estimate.lambda.
Verdict Judge(const Identification& identification, const ParameterSet& parameters,
              const std::vector<PoseError>& control_before,
              const std::vector<PoseError>& control_after);

// apply becomes apply_within_volume when the measured poses cover so little that elsewhere within
// the joint ranges the uncertainty of the parameters alone exceeds what stays unexplained anyway,
// and twice what it is at the measured poses. All RMS position, m.
void JudgeVolume(double uncertainty_measured_m, double uncertainty_elsewhere_m,
                 double unexplained_m, Verdict* verdict);

// apply becomes apply_within_volume when a selection left parameters at nominal.
// @param path of the selection; empty = none was made.
void JudgeSelection(const std::vector<SelectionStep>& path, Verdict* verdict);

// do_not_apply when the readings of a partial recalibration don't fit the parameters that are held,
// uncertain as those are, beyond chance: p < 0.001.
// @param chi_square, degrees_of_freedom, p_value of that test (calibrate/change.h).
void JudgeHeldFit(double chi_square, int degrees_of_freedom, double p_value, Verdict* verdict);

// do_not_apply when parameters found anew don't differ from the stored ones beyond chance.
void JudgeChange(double p_value, bool real, Verdict* verdict);

}  // namespace truepose
