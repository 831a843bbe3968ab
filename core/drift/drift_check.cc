#include "core/drift/drift_check.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/drift/drift_findings.h"
#include "core/drift/drift_pairs.h"
#include "core/drift/drift_parts.h"
#include "core/drift/drift_tests.h"
#include "core/identification/candidate_values.h"
#include "core/identification/start_values.h"

namespace truepose {
namespace {

constexpr double kChanged = 0.01, kBeyondOnePart = 0.001, kLeastLead = 2;

absl::Status CheckSizes(const DriftProblem& problem) {
  FaultList faults;
  if (problem.check.readings.empty())
    faults.Add("readings", "none that can be used", "at least one");
  const int n = problem.check.CandidateCount();
  if (problem.covariance.rows() != n || problem.covariance.cols() != n)
    faults.Add("covariance",
               absl::StrCat(problem.covariance.rows(), " x ", problem.covariance.cols()),
               absl::StrCat(n, " x ", n, ", a row for each candidate"));
  return faults.ToStatus();
}

void Thin(std::vector<Reading>* readings) {
  const size_t n = readings->size();
  if (n <= kMostCheckReadings) return;
  for (size_t i = 0; i < kMostCheckReadings; ++i)
    (*readings)[i] = (*readings)[i * n / kMostCheckReadings];
  readings->resize(kMostCheckReadings);
}

// Frames that are not held, near enough for the fits.
absl::StatusOr<Estimate> StartOf(const DriftProblem& problem, const Hooks& hooks) {
  Estimate start = problem.active;
  if (start.offsets.size() != static_cast<Eigen::Index>(problem.check.offsets.size()))
    start.offsets = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.check.offsets.size()));
  const Freedom free = LegitimateChanges(problem);
  if (free.candidates.empty()) return start;
  StartOptions options{problem.X_FT_nominal, start, problem.base_held, problem.tool_held};
  TRUEPOSE_ASSIGN_OR_RETURN(Estimate found, FindStart(problem.check, options, hooks));
  found.lambda = problem.active.lambda;
  return found;
}

absl::Status CheckRows(const DriftFitter& fitter, const DriftFit& all) {
  if (fitter.rows() > all.rank) return absl::OkStatus();
  FaultList faults;
  faults.Add("readings", absl::StrCat(fitter.rows(), " measured values"),
             absl::StrCat("more than ", all.rank, ", the changes that are looked for"));
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

absl::StatusOr<SingleFits> FitAll(const DriftProblem& problem, const DriftFitter& fitter,
                                  const Hooks& hooks) {
  SingleFits fits{LegitimateChanges(problem), {}, {}, PartsOf(problem), {}, {}};
  Freedom everything = fits.legitimate;
  for (const CandidatePart& part : fits.parts) everything = everything + part.freedom;
  fits.none = fitter.Fit(fits.legitimate);
  fits.all = fitter.Fit(everything);
  TRUEPOSE_RETURN_IF_ERROR(CheckRows(fitter, fits.all));
  for (const CandidatePart& part : fits.parts) {
    if (hooks.Cancelled()) return absl::CancelledError("cancelled");
    fits.of_parts.push_back(fitter.Fit(fits.legitimate + part.freedom));
  }
  fits.sums = {std::max(0.0, fits.none.chi_square - fits.all.chi_square),
               fits.all.chi_square,
               fits.all.rank - fits.none.rank,
               fitter.rows() - fits.all.rank,
               problem.redundancy,
               SumsOfReadings(problem.check, fits.all.whitened)};
  return fits;
}

DriftPart PartOf(const DriftProblem& problem, const SingleFits& fits, size_t i) {
  const CandidatePart& candidate = fits.parts[i];
  const DriftFit& fit = fits.of_parts[i];
  DriftPart part;
  part.name = candidate.name;
  part.chi_square = std::max(0.0, fits.none.chi_square - fit.chi_square);
  part.degrees_of_freedom = fit.rank - fits.none.rank;
  part.p_value = DropProbability(fits.sums, part.chi_square, part.degrees_of_freedom);
  part.bic = -part.chi_square / fits.sums.Scale() +
             part.degrees_of_freedom * std::log(static_cast<double>(fit.whitened.size()));
  const auto legitimate = static_cast<Eigen::Index>(fits.legitimate.candidates.size());
  const auto frames = static_cast<Eigen::Index>(candidate.freedom.candidates.size());
  SetChange(problem, candidate, fit.changes.segment(legitimate, frames), fit.joints, &part);
  return part;
}

// Whether all parts together explain more than this one does.
bool LeavesMore(const SingleFits& fits, const DriftPart& part) {
  const int freedom = fits.sums.drop_freedom - part.degrees_of_freedom;
  const double more = fits.sums.drop - part.chi_square;
  return DropProbability(fits.sums, more, freedom) < kBeyondOnePart;
}

std::string Attributed(const SingleFits& fits, const std::vector<DriftPart>& parts) {
  if (parts.empty() || LeavesMore(fits, parts[0])) return "";
  if (parts[0].p_value * static_cast<double>(parts.size()) >= kChanged) return "";
  if (parts.size() > 1 && parts[1].bic - parts[0].bic < kLeastLead) return "";
  return parts[0].name;
}

void NameTwo(const DriftProblem& problem, const DriftFitter& fitter, const SingleFits& fits,
             DriftCheckResult* result) {
  std::optional<std::vector<DriftPart>> both = ChangedTogether(problem, fitter, fits);
  if (!both.has_value()) return;
  result->attributed_to = absl::StrCat((*both)[0].name, " and ", (*both)[1].name);
  result->together = *std::move(both);
}

// Errors under the calibration as it is: held frames exactly there.
Statistics PositionOf(const DriftProblem& problem, const DriftFitter& fitter,
                      const Estimate& start) {
  const DriftFit fit = fitter.Fit(LegitimateChanges(problem), /*with_covariance=*/false);
  const Estimate estimate = EstimateAt(problem.check, start, fit.values);
  return PoseStatisticsOf(PoseErrors(problem.check, estimate)).position_m;
}

bool All(const std::vector<bool>& flags) {
  return std::all_of(flags.begin(), flags.end(), [](bool flag) { return flag; });
}

}  // namespace

absl::StatusOr<DriftCheckResult> CheckDrift(const DriftProblem& whole, const Hooks& hooks) {
  TRUEPOSE_RETURN_IF_ERROR(CheckSizes(whole));
  DriftProblem problem = whole;
  problem.check.prior.reset();
  Thin(&problem.check.readings);
  TRUEPOSE_ASSIGN_OR_RETURN(const Estimate start, StartOf(problem, hooks));
  const DriftFitter fitter(problem, start);
  TRUEPOSE_ASSIGN_OR_RETURN(const SingleFits fits, FitAll(problem, fitter, hooks));
  DriftCheckResult result;
  result.poses = static_cast<int>(problem.check.readings.size());
  result.position_m = PositionOf(problem, fitter, start);
  result.chi_square = fits.none.chi_square;
  result.degrees_of_freedom = fitter.rows() - fits.none.rank;
  result.p_value = ChangeProbability(fits.sums);
  result.changed = result.p_value < kChanged;
  result.base_observable = All(problem.base_held);
  result.tool_observable = All(problem.tool_held);
  for (size_t i = 0; i < fits.parts.size(); ++i) result.parts.push_back(PartOf(problem, fits, i));
  std::stable_sort(result.parts.begin(), result.parts.end(),
                   [](const DriftPart& a, const DriftPart& b) { return a.bic < b.bic; });
  if (result.changed) result.attributed_to = Attributed(fits, result.parts);
  const bool more = !result.parts.empty() && LeavesMore(fits, result.parts[0]);
  if (result.changed && more) NameTwo(problem, fitter, fits, &result);
  result.findings = FindingsOf(result, fits.sums, more);
  return result;
}

}  // namespace truepose
