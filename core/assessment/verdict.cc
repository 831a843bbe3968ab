#include "core/assessment/verdict.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/chi_square.h"
#include "core/base/random.h"

namespace truepose {
namespace {

constexpr int kDraws = 2000;
// Below this many rows a bootstrap has next to nothing to draw from.
constexpr int kFewControlRows = 10;

int DroppedForReadings(const IdentifiableSet& set) {
  return static_cast<int>(
      std::count_if(set.redundancies.begin(), set.redundancies.end(),
                    [](const NullRelation& relation) { return !relation.structural; }));
}

void JudgeControlSize(int rows, Verdict* verdict) {
  if (rows >= kFewControlRows) return;
  verdict->decision = Decision::kApplyWithinVolume;
  verdict->reasons.push_back(
      rows == 0
          ? std::string("there is no control set: nothing shows how far the result carries")
          : absl::StrCat("only ", rows, rows == 1 ? " control row shows" : " control rows show",
                         " how far the result carries: that is little"));
}

// Draws of fewer rows are all alike more often than an interval of 95 % leaves out: of 4 the same
// one four times in 1 of 64 draws.
constexpr int kLeastForInterval = 5;

void JudgeWithoutInterval(double ratio, int rows, Verdict* verdict) {
  verdict->reasons.push_back(absl::StrFormat(
      "control RMS position after / before is %.3f; a 95 %% interval of it needs %d control rows, "
      "found %d",
      ratio, kLeastForInterval, rows));
  if (ratio < 1) return;
  verdict->decision = Decision::kDoNotApply;
  verdict->reasons.push_back("the control set shows no improvement");
}

// Two fits of the same frames to the same readings end where their tolerances let them, and errors
// differ by 1e-7 of themselves: a ratio that is nearer to 1 than this is 1. No instrument shows a
// millionth of an error.
constexpr double kRoundOff = 1e-6;

void JudgeControl(const std::vector<PoseError>& before, const std::vector<PoseError>& after,
                  Verdict* verdict) {
  const double ratio = PoseStatisticsOf(after).position_m.rms /
                       std::max(PoseStatisticsOf(before).position_m.rms, 1e-12);
  const int rows = UnitsOf(before).count;
  if (rows < kLeastForInterval) {
    JudgeWithoutInterval(ratio, rows, verdict);
    return;
  }
  const auto [low, high] = BootstrapRatio(before, after);
  verdict->reasons.push_back(absl::StrFormat(
      "control RMS position after / before is %.3f, 95 %% interval %.3f to %.3f over %d rows",
      ratio, low, high, rows));
  if (!(high < 1 - kRoundOff)) {
    verdict->decision = Decision::kDoNotApply;
    verdict->reasons.push_back("an improvement on the control set is not proved");
  }
}

constexpr double kLargestLength_m = 0.1;
constexpr double kLargestAngle_rad = 0.1745;

void JudgeSizes(const Eigen::VectorXd& lambda, const ParameterSet& parameters, Verdict* verdict) {
  for (int i = 0; i < static_cast<int>(lambda.size()); ++i) {
    const bool angle = parameters[i].is_angle();
    if (std::abs(lambda(i)) <= (angle ? kLargestAngle_rad : kLargestLength_m)) continue;
    verdict->decision = Decision::kDoNotApply;
    const double shown = lambda(i) * (angle ? 180 / std::numbers::pi : 1e3);
    verdict->reasons.push_back(
        absl::StrFormat("%s = %.4g %s is no error that a robot has: check the order and units of "
                        "the joints, and the robot file",
                        parameters[i].name, shown, angle ? "deg" : "mm"));
  }
}

// One false alarm in a thousand recalibrations.
constexpr double kHeldFitChance = 1e-3;

constexpr double kMostUnexplained_m = 5e-3;
constexpr double kMostUnexplained_rad = 0.5 * std::numbers::pi / 180;

void JudgeUnexplained(const ModelError& error, Verdict* verdict) {
  if (error.position_sd_m <= kMostUnexplained_m && error.rotation_sd_rad <= kMostUnexplained_rad)
    return;
  verdict->decision = Decision::kDoNotApply;
  verdict->reasons.push_back(absl::StrFormat(
      "%.3g mm and %.3g deg stay unexplained, beyond %.3g mm or %.3g deg: the readings are not "
      "those of this robot; check the units, the order of the joints, the anchors and the robot "
      "file",
      1e3 * error.position_sd_m, error.rotation_sd_rad * 180 / std::numbers::pi,
      1e3 * kMostUnexplained_m, kMostUnexplained_rad * 180 / std::numbers::pi));
}

// Whether any active candidate is one of the robot's own.
bool FoundAnyInternal(const Identification& identification) {
  const Estimate& estimate = identification.estimate;
  const auto first = static_cast<int>(
      kFrameParameters * (estimate.X_MB.size() + estimate.X_FT.size()) + estimate.offsets.size());
  const std::vector<int>& active = identification.set.active;
  return !active.empty() && active.back() >= first;
}

void JudgeScope(const Identification& identification, Verdict* verdict) {
  if (FoundAnyInternal(identification)) return;
  verdict->decision = Decision::kDoNotApply;
  verdict->reasons.push_back(
      "nothing of the robot was identified: base and tool are where they are, and the robot "
      "moves as before");
}

// Advice that fits what was tried.
void JudgeTermination(const SolveSummary& summary, Verdict* verdict) {
  if (summary.termination == Termination::kConverged) return;
  verdict->decision = Decision::kDoNotApply;
  verdict->reasons.push_back(
      absl::StrCat("identification ended with ", Name(summary.termination),
                   ": not converged, so no figure of it counts; try --estimator "
                   "levenberg_marquardt, more different poses or --prior tolerance"));
}

// Sums of squares of the units.
Eigen::VectorXd SquaresOf(const std::vector<PoseError>& errors, const Units& units) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(units.count);
  for (size_t i = 0; i < errors.size(); ++i)
    squares(units.of[i]) += errors[i].position_m * errors[i].position_m;
  return squares;
}

}  // namespace

const char* Name(Decision decision) {
  switch (decision) {
    case Decision::kApply:
      return "apply";
    case Decision::kApplyWithinVolume:
      return "apply_within_volume";
    case Decision::kDoNotApply:
      break;
  }
  return "do_not_apply";
}

Interval BootstrapRatio(const std::vector<PoseError>& before, const std::vector<PoseError>& after) {
  const Units units = UnitsOf(before);
  const Eigen::VectorXd squares_before = SquaresOf(before, units),
                        squares_after = SquaresOf(after, units);
  Random random(1);
  std::vector<double> ratios;
  for (int draw = 0; draw < kDraws; ++draw) {
    double b = 0, a = 0;
    for (int i = 0; i < units.count; ++i) {
      const auto k = static_cast<Eigen::Index>(random.Below(static_cast<uint64_t>(units.count)));
      b += squares_before(k);
      a += squares_after(k);
    }
    ratios.push_back(std::sqrt(a / std::max(b, 1e-24)));
  }
  std::sort(ratios.begin(), ratios.end());
  return {ratios[kDraws / 40], ratios[kDraws - 1 - kDraws / 40]};
}

Verdict Judge(const Identification& identification, const ParameterSet& parameters,
              const std::vector<PoseError>& control_before,
              const std::vector<PoseError>& control_after) {
  Verdict verdict;
  verdict.decision = Decision::kApply;
  if (const int dropped = DroppedForReadings(identification.set); dropped > 0) {
    verdict.decision = Decision::kApplyWithinVolume;
    verdict.reasons.push_back(absl::StrCat(
        dropped, " parameters stayed nominal because these readings do not determine them"));
  }
  JudgeControlSize(UnitsOf(control_before).count, &verdict);
  if (!control_before.empty()) JudgeControl(control_before, control_after, &verdict);
  JudgeSizes(identification.estimate.lambda, parameters, &verdict);
  JudgeUnexplained(UnexplainedOf(identification), &verdict);
  JudgeScope(identification, &verdict);
  JudgeTermination(identification.summary, &verdict);
  return verdict;
}

void JudgeVolume(double uncertainty_measured_m, double uncertainty_elsewhere_m,
                 double unexplained_m, Verdict* verdict) {
  if (uncertainty_elsewhere_m <= std::max(unexplained_m, 2 * uncertainty_measured_m)) return;
  if (verdict->decision == Decision::kApply) verdict->decision = Decision::kApplyWithinVolume;
  verdict->reasons.push_back(absl::StrFormat(
      "the parameters alone leave %.3f mm uncertain at the measured poses, but %.3f mm elsewhere "
      "(unexplained anyway: %.3f mm): the poses cover little",
      1e3 * uncertainty_measured_m, 1e3 * uncertainty_elsewhere_m, 1e3 * unexplained_m));
}

void JudgeSelection(const std::vector<SelectionStep>& path, Verdict* verdict) {
  if (path.empty()) return;
  if (verdict->decision == Decision::kApply) verdict->decision = Decision::kApplyWithinVolume;
  const auto taken = std::count_if(path.begin(), path.end(), [](const SelectionStep& step) {
    return step.taken && !step.added.empty();
  });
  verdict->reasons.push_back(absl::StrCat(
      "a selection chose ", taken,
      " parameters beside offsets and lengths; the others stayed nominal at these poses"));
}

void JudgeHeldFit(double chi_square, int degrees_of_freedom, double p_value, Verdict* verdict) {
  if (degrees_of_freedom <= 0 || p_value >= kHeldFitChance) return;
  verdict->decision = Decision::kDoNotApply;
  verdict->reasons.push_back(absl::StrFormat(
      "the readings do not fit what is held from the earlier calibration (residual variance %.2f "
      "with its uncertainty, expected 1; p = %.2g): something else has changed too; find it with "
      "more parameters or all",
      chi_square / degrees_of_freedom, p_value));
}

void JudgeChange(double p_value, bool real, Verdict* verdict) {
  if (!real) verdict->decision = Decision::kDoNotApply;
  verdict->reasons.push_back(
      absl::StrFormat(real ? "the change from the earlier calibration is real (p = %.2g)"
                           : "what was found anew differs from the earlier calibration by no more "
                             "than chance (p = %.2g)",
                      p_value));
}

}  // namespace truepose
