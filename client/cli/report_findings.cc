#include "client/cli/report_findings.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "client/cli/names.h"
#include "client/cli/report.h"
#include "client/cli/table.h"

namespace truepose::cli {
namespace {

constexpr char kIndent[] = "  ";
// Enough to act on; --json has all.
constexpr int kMostRows = 10;
// Pairs are short, and where poses are poor there are many: the pattern shows in twenty.
constexpr int kMostPairs = 20;

void AppendSection(const std::string& title, const std::string& body, std::string* text) {
  if (!body.empty()) absl::StrAppend(text, "\n", title, "\n", body);
}

std::string MoreText(int count, int most) {
  return count <= most ? "" : absl::StrCat(kIndent, "and ", count - most, " more (--json)\n");
}

std::string CountsText(const v1::ParameterCounts& counts) {
  if (counts.complete() == 0) return "";
  return absl::StrFormat(
      "%s4R + 2P + 6 = %d, with this measurement 4R + 2P + G = %d, internal 4R + 2P - 6 = %d; at "
      "any "
      "poses %d can be told, at these %d\n",
      kIndent, counts.complete(), counts.measured(), counts.internal(), counts.generic_rank(),
      counts.rank());
}

std::string SelectionText(const v1::CalibrationReport& report) {
  if (report.selection_size() == 0) return "";
  Table table({{"added", Align::kLeft},
               {"parameters"},
               {"weighted rms"},
               {"criterion"},
               {"", Align::kLeft}});
  for (const v1::SelectionStep& step : report.selection()) {
    table.Add({step.added().empty() ? "(start)" : step.added(), absl::StrCat(step.parameters()),
               Fixed(step.weighted_rms(), 4), absl::StrFormat("%.6g", step.criterion()),
               step.taken() ? "taken" : "not taken"});
  }
  return table.Text(kIndent);
}

// As the user named it; with the number alone nobody knows from where it counts.
std::string SessionText(const v1::Calibration& calibration, int session) {
  if (session < 0 || session >= calibration.sessions_size()) return absl::StrCat("#", session);
  return ShortName(calibration.sessions(session));
}

std::string SuspectsText(const v1::Calibration& calibration) {
  const v1::CalibrationReport& report = calibration.report();
  if (report.suspects_size() == 0) return "";
  Table table({{"session", Align::kLeft}, {"row"}, {"weight"}, {"reason", Align::kLeft}});
  for (int i = 0; i < std::min(report.suspects_size(), kMostRows); ++i) {
    const v1::Suspect& suspect = report.suspects(i);
    table.Add({SessionText(calibration, suspect.session()), absl::StrCat(suspect.row()),
               Fixed(suspect.weight(), 2), suspect.reason()});
  }
  return absl::StrCat(table.Text(kIndent), MoreText(report.suspects_size(), kMostRows));
}

std::string CorrelationsText(const v1::CalibrationReport& report) {
  if (report.correlations_size() == 0) return "";
  std::vector<v1::Correlation> strongest(report.correlations().begin(),
                                         report.correlations().end());
  std::stable_sort(strongest.begin(), strongest.end(),
                   [](const v1::Correlation& a, const v1::Correlation& b) {
                     return std::abs(a.value()) > std::abs(b.value());
                   });
  std::string text;
  for (size_t i = 0; i < std::min<size_t>(strongest.size(), kMostPairs); ++i)
    absl::StrAppendFormat(&text, "%s%s ~ %s %.3f\n", kIndent, strongest[i].a(), strongest[i].b(),
                          strongest[i].value());
  return absl::StrCat(text, MoreText(report.correlations_size(), kMostPairs));
}

}  // namespace

std::string FindingsText(const v1::Calibration& calibration) {
  const v1::CalibrationReport& report = calibration.report();
  std::string text;
  AppendSection("Number of parameters", CountsText(report.counts()), &text);
  AppendSection("Choice of parameters and effects, by the calibration rows", SelectionText(report),
                &text);
  AppendSection("Parameters that the readings hardly tell apart", CorrelationsText(report), &text);
  AppendSection("Readings that do not fit the others (rows count from 0, as in --split)",
                SuspectsText(calibration), &text);
  return text;
}

std::string PreviewText(const v1::JobPreview& preview) {
  v1::CalibrationReport report;
  *report.mutable_redundancies() = preview.redundancies();
  std::string text = absl::StrCat(
      "Preview: nothing was run. ", Count(preview.readings(), "reading"), " determine ",
      Count(preview.identifiable_size(), "parameter"), " of base, tool and robot.\n");
  AppendSection("Number of parameters", CountsText(preview.counts()), &text);
  AppendSection("Parameters that would be identified",
                absl::StrCat(kIndent, absl::StrJoin(preview.identifiable(), " "), "\n"), &text);
  AppendSection("Parameters that stay at nominal", RedundanciesText(report), &text);
  return text;
}

std::string PlacesText(const v1::CalibrationReport& report) {
  if (!report.has_control_places()) return "";
  const v1::Statistics& mm = report.control_places().after().position_mm();
  return absl::StrFormat(
      "%s%d rows: rms %.3f mm, mean %.3f, max %.3f; largest error of a distance "
      "between places %.3f mm\n",
      kIndent, report.control_places().poses(), mm.rms(), mm.mean(), mm.max(),
      report.largest_spacing_error_mm());
}

std::string AccuracyText(const v1::CalibrationReport& report) {
  std::string text;
  if (report.has_predicted()) {
    const v1::PredictedAccuracy& predicted = report.predicted();
    absl::StrAppendFormat(&text,
                          "Predicted accuracy of the tool: %.3f mm RMS; %.1f %% of the control "
                          "rows lie in their 95 %% "
                          "region (%.1f %% by the covariance of the parameters alone)\n",
                          predicted.position_rms_mm(),
                          100.0 * predicted.inside() / predicted.control(),
                          100.0 * predicted.inside_covariance_alone() / predicted.control());
  }
  if (report.has_repeatability()) {
    const v1::Repeatability& repeat = report.repeatability();
    absl::StrAppendFormat(&text,
                          "Repeatability: %d pairs differ by %.3f mm, sd %.3f; mean + 3 sd %.3f mm "
                          "(the chapter's); ISO "
                          "9283 RP %.3f mm from %d groups\n",
                          repeat.pairs(), repeat.difference_mean_mm(), repeat.difference_sd_mm(),
                          repeat.chapter_mm(), repeat.iso_rp_mm(), repeat.groups());
  }
  if (report.has_change() && report.change().names_size() > 0) {
    absl::StrAppendFormat(&text, "Change of %s: chi-square %.2f of %d, p = %.2g: %s\n",
                          absl::StrJoin(report.change().names(), ", "),
                          report.change().chi_square(), report.change().degrees_of_freedom(),
                          report.change().p_value(), report.change().real() ? "real" : "chance");
  }
  if (report.covariance_approximate())
    absl::StrAppend(&text, "The standard deviations are approximate: one pass of the filter\n");
  if (!report.joints_compared().empty())
    absl::StrAppend(&text, "Both joint sources: ", report.joints_compared(), "\n");
  return text;
}

}  // namespace truepose::cli
