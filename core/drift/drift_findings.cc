#include "core/drift/drift_findings.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace truepose {
namespace {

constexpr double kMmPerM = 1e3, kDegPerRad = 57.295779513082320877;

std::string ChangeText(const DriftPart& part) {
  std::string text;
  if (part.change_m > 0) text = absl::StrFormat("%.3f mm", part.change_m * kMmPerM);
  if (part.change_rad > 0)
    absl::StrAppend(&text, text.empty() ? "" : " and ",
                    absl::StrFormat("%.4f deg", part.change_rad * kDegPerRad));
  return text;
}

std::string Overall(const DriftCheckResult& result) {
  return absl::StrFormat(
      "%s (p = %.2g, %d readings): RMS position error %.3f mm under the calibration.",
      result.changed ? "Something has changed" : "Nothing has changed beyond chance",
      result.p_value, result.poses, result.position_m.rms * kMmPerM);
}

std::string Both(const DriftCheckResult& result) {
  const DriftPart &a = result.together[0], &b = result.together[1];
  return absl::StrCat("No single part explains it, but two do: ", a.name, " by ", ChangeText(a),
                      ", and ", b.name, " by ", ChangeText(b), ".");
}

std::string WhereItIs(const DriftCheckResult& result, bool more) {
  if (!result.together.empty()) return Both(result);
  if (!result.attributed_to.empty())
    return absl::StrFormat(
        "It points to %s: a change of %s explains %.0f of the chi-square of %.0f.",
        result.attributed_to, ChangeText(result.parts[0]), result.parts[0].chi_square,
        result.chi_square);
  if (result.parts.empty()) return "No part of it can be told from the others.";
  if (more)
    return absl::StrFormat(
        "No single part explains it: %s would leave changes beyond chance, so several parts have "
        "changed or something that is no part.",
        result.parts[0].name);
  return absl::StrFormat("No part stands out; %s is the likeliest.", result.parts[0].name);
}

std::string Scatter(const DriftSums& sums) {
  return absl::StrFormat(
      "What no motion of a part explains is %.2f times what the calibration left unexplained%s.",
      std::sqrt(sums.rest / sums.rest_freedom),
      RestProbability(sums) < 0.005 ? ", beyond chance" : "");
}

}  // namespace

std::vector<std::string> FindingsOf(const DriftCheckResult& result, const DriftSums& sums,
                                    bool more) {
  std::vector<std::string> findings = {Overall(result)};
  if (result.changed) findings.push_back(WhereItIs(result, more));
  if (result.changed) findings.push_back(Scatter(sums));
  if (!result.base_observable)
    findings.push_back(
        "base: not observable, since placement or fixture may have moved: it was fitted to the "
        "check, and joint 1 with it.");
  if (!result.tool_observable)
    findings.push_back(
        "tool: not observable, since another target was measured: it was fitted to the check, and "
        "the last joint with it.");
  return findings;
}

}  // namespace truepose
