#include "client/cli/report.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/string_view.h"
#include "absl/strings/strip.h"
#include "absl/time/time.h"
#include "client/cli/histogram.h"
#include "client/cli/report_findings.h"
#include "client/cli/table.h"

namespace truepose::cli {
namespace {

constexpr char kIndent[] = "  ";
// Finer than any instrument resolves: 0.1 um and 0.1 mdeg.
constexpr int kDigits = 4;
// Of statistics.
constexpr int kFewDigits = 3;

void AddStatistics(bool present, const v1::Statistics& statistics,
                   std::vector<std::string>* cells) {
  for (const double value :
       {statistics.mean(), statistics.sd(), statistics.rms(), statistics.max()}) {
    cells->push_back(present ? Fixed(value, kFewDigits) : "");
  }
}

void AddRow(const std::string& set, const std::string& rows, const std::string& when,
            const v1::PoseStatistics& statistics, Table* table) {
  std::vector<std::string> cells = {set, rows, when};
  AddStatistics(statistics.has_position_mm(), statistics.position_mm(), &cells);
  AddStatistics(statistics.has_rotation_deg(), statistics.rotation_deg(), &cells);
  table->Add(std::move(cells));
}

void AddSet(const std::string& title, const v1::SetReport& set, Table* table) {
  if (set.poses() == 0) return;
  AddRow(title, absl::StrCat(set.poses()), "before", set.before(), table);
  AddRow("", "", "after", set.after(), table);
}

Table EmptySetsTable() {
  return Table({{"set", Align::kLeft},
                {"rows"},
                {"", Align::kLeft},
                {"mm: mean"},
                {"sd"},
                {"rms"},
                {"max"},
                {"deg: mean"},
                {"sd"},
                {"rms"},
                {"max"}});
}

std::string GroupName(v1::ParameterGroup group) {
  switch (group) {
    case v1::INTERNAL:
      return "internal";
    case v1::BASE:
      return "base";
    case v1::TOOL:
      return "tool";
    case v1::INSTRUMENT:
      return "instrument";
    default:
      return "";
  }
}

Colour ColourOf(const std::string& verdict) {
  if (verdict == "apply") return Colour::kGreen;
  return verdict == "do_not_apply" ? Colour::kRed : Colour::kYellow;
}

// "converged after 7 iterations; 30 parameters from 8322 residuals, condition 41"
std::string SummaryLine(const v1::CalibrationReport& report) {
  const v1::Summary& summary = report.summary();
  return absl::StrCat(absl::StrReplaceAll(summary.termination(), {{"_", " "}}), " after ",
                      Count(summary.iterations(), "iteration"), "; ",
                      Count(report.parameters().identified(), "parameter"), " identified from ",
                      Count(summary.residuals(), "residual"), ", condition ",
                      absl::StrFormat("%.3g", summary.condition()));
}

// "unexplained per axis: 0.284 mm, 0.034 deg; weighted residual variance 1.00"; without the angle
// where none was measured.
std::string NoiseLine(const v1::CalibrationReport& report) {
  const v1::Summary& summary = report.summary();
  std::string text = absl::StrCat(
      "unexplained per axis: ", Fixed(summary.model_sd_position_mm(), kFewDigits), " mm");
  const bool measured = report.sets().calibration().after().has_rotation_deg();
  if (measured && summary.model_sd_rotation_deg() > 0)
    absl::StrAppend(&text, ", ", Fixed(summary.model_sd_rotation_deg(), kFewDigits), " deg");
  absl::StrAppendFormat(&text, "; weighted residual variance %.2f",
                        summary.weighted_residual_variance());
  return text;
}

constexpr char kNotConverged[] =
    "Not converged: the figures below are those of the last iteration and mean little";

// ", prior tolerance, loss tukey": what was asked for beside the defaults.
std::string OptionsText(const v1::CalibrationOptions& options) {
  std::string text;
  const auto add = [&text](const char* name, const std::string& value) {
    if (!value.empty() && value != "none" && value != "all")
      absl::StrAppend(&text, ", ", name, " ", value);
  };
  add("objective", options.objective());
  add("calibrate", options.calibrate());
  add("prior", options.prior() == "calibration" ? options.prior_calibration().name().empty()
                                                      ? "calibration"
                                                      : options.prior_calibration().name()
                                                : options.prior());
  add("select", options.select());
  add("effects", options.effects());
  add("loss", options.loss());
  add("pose matching", options.pose_matching());
  if (options.has_fixture()) absl::StrAppend(&text, ", fixture ", options.fixture().name());
  return text;
}

std::string HeadText(const v1::CalibrationReport& report, const v1::CalibrationOptions& options) {
  std::string text = absl::StrCat(
      "Model ", report.model(), ", estimator ", report.estimator(), ", ", report.joints_used(),
      " joints, split ", report.split().empty() ? "none (all rows calibrate)" : report.split(),
      OptionsText(options), "\n");
  absl::StrAppend(&text, SummaryLine(report), "\n", NoiseLine(report), "\n");
  if (report.summary().termination() != "converged") absl::StrAppend(&text, kNotConverged, "\n");
  if (report.summary().termination() != "converged" && !report.summary().message().empty()) {
    absl::StrAppend(&text, report.summary().message(), "\n");
  }
  return text;
}

// Enough to show two significant digits of the deviation: a compliance in deg/(N m) has them beyond
// the fourth.
int DigitsOf(const v1::ParameterValue& value) {
  constexpr int kMostDigits = 12;
  if (!(value.sd() > 0)) return kDigits;
  const int digits = 1 - static_cast<int>(std::floor(std::log10(value.sd())));
  return std::clamp(digits, kDigits, kMostDigits);
}

void AddParameter(const v1::ParameterValue& value, Table* table) {
  const int digits = DigitsOf(value);
  table->Add({value.name(), GroupName(value.group()), Fixed(value.nominal(), digits),
              Fixed(value.identified(), digits),
              Fixed(value.identified() - value.nominal(), digits), Fixed(value.sd(), digits),
              value.unit()});
}

// "+1 dq2" of the relation "dbeta2 = +1 dq2"; without a relation the whole reason.
std::string ActsAs(const v1::Redundancy& redundancy) {
  absl::string_view text =
      redundancy.relation().empty() ? redundancy.reason() : redundancy.relation();
  absl::ConsumePrefix(&text, absl::StrCat(redundancy.dropped(), " = "));
  return std::string(text);
}

bool HasControl(const v1::Calibration& calibration) {
  for (const v1::RowResidual& residual : calibration.residuals()) {
    if (residual.control()) return true;
  }
  return false;
}

void AppendSection(const std::string& title, const std::string& body, std::string* text) {
  if (!body.empty()) absl::StrAppend(text, "\n", title, "\n", body);
}

}  // namespace

std::string SetTable(const std::string& title, const v1::SetReport& set) {
  Table table = EmptySetsTable();
  AddSet(title, set, &table);
  return table.Text(kIndent);
}

std::string SetsTable(const v1::Sets& sets) {
  Table table = EmptySetsTable();
  AddSet("calibration", sets.calibration(), &table);
  AddSet("control", sets.control(), &table);
  AddSet("complete", sets.complete(), &table);
  return table.Text(kIndent);
}

std::string ParametersTable(const v1::ParameterReport& parameters, bool from_earlier) {
  Table table({{"name", Align::kLeft},
               {"group", Align::kLeft},
               {from_earlier ? "earlier" : "nominal"},
               {"identified"},
               {"change"},
               {"sd"},
               {"unit", Align::kLeft}});
  // The robot's own parameters first; the report has them in the order of the covariance.
  for (const v1::ParameterGroup group :
       {v1::INTERNAL, v1::TOOL, v1::BASE, v1::INSTRUMENT, v1::PARAMETER_GROUP_UNSPECIFIED}) {
    for (int i = 0; i < parameters.identified(); ++i) {  // further ones are held
      if (parameters.values(i).group() == group) AddParameter(parameters.values(i), &table);
    }
  }
  return table.empty() ? "" : table.Text(kIndent);
}

std::string RedundanciesText(const v1::CalibrationReport& report) {
  Table table({{"parameter", Align::kLeft}, {"acts as", Align::kLeft}, {"", Align::kLeft}});
  for (const v1::Redundancy& redundancy : report.redundancies()) {
    table.Add({redundancy.dropped(), ActsAs(redundancy),
               redundancy.structural() ? "at any poses" : "at these poses"});
  }
  return table.empty() ? "" : table.Text(kIndent);
}

std::string FramesTable(const v1::CalibrationReport& report) {
  Table table({{"frame", Align::kLeft},
               {"name", Align::kLeft},
               {"x mm"},
               {"y mm"},
               {"z mm"},
               {"qx"},
               {"qy"},
               {"qz"},
               {"qw"},
               {"fitted on", Align::kLeft}});
  for (const v1::FrameEstimate& frame : report.frames()) {
    const v1::Pose& pose = frame.pose();
    table.Add({GroupName(frame.group()), frame.name(), Fixed(1e3 * pose.x_m(), kFewDigits),
               Fixed(1e3 * pose.y_m(), kFewDigits), Fixed(1e3 * pose.z_m(), kFewDigits),
               Fixed(pose.qx(), 6), Fixed(pose.qy(), 6), Fixed(pose.qz(), 6), Fixed(pose.qw(), 6),
               frame.fitted_on()});
  }
  return table.empty() ? "" : table.Text(kIndent);
}

std::string ResidualHistogram(const v1::Calibration& calibration, bool utf8) {
  const bool control_only = HasControl(calibration);
  std::vector<double> before, after;
  for (const v1::RowResidual& residual : calibration.residuals()) {
    if (control_only && !residual.control()) continue;
    before.push_back(residual.before_position_mm());
    after.push_back(residual.after_position_mm());
  }
  const std::string bars = BeforeAfterHistogram(before, after, "mm", utf8);
  if (bars.empty()) return "";
  return absl::StrCat("Position residuals of the ", control_only ? "control rows" : "rows",
                      " in mm\n", bars);
}

std::string VerdictText(const v1::CalibrationReport& report, const Console& console) {
  const std::string words = absl::StrReplaceAll(report.verdict(), {{"_", " "}});
  std::string text =
      absl::StrCat("Verdict: ", Paint(console, ColourOf(report.verdict()), words), "\n");
  for (const std::string& reason : report.verdict_reasons())
    absl::StrAppend(&text, kIndent, reason, "\n");
  return text;
}

std::string CalibrationText(const v1::Calibration& calibration, const Console& console) {
  // What matters most comes last, where a terminal shows it.
  const v1::CalibrationReport& report = calibration.report();
  std::string text = HeadText(report, calibration.options());
  AppendSection("Parameters", ParametersTable(report.parameters(), report.has_change()), &text);
  AppendSection("Tool in the frame of the flange, base in that of the instrument",
                FramesTable(report), &text);
  AppendSection("Parameters that stay at nominal", RedundanciesText(report), &text);
  absl::StrAppend(&text, FindingsText(calibration));
  AppendSection("Residuals", SetsTable(report.sets()), &text);
  AppendSection("Control rows against the mean of their own place in the fixture",
                PlacesText(report), &text);
  if (!calibration.residuals().empty()) {
    absl::StrAppend(&text, "\n", ResidualHistogram(calibration, console.utf8));
  }
  for (const std::string& warning : report.warnings()) {
    absl::StrAppend(&text, "\n", Paint(console, Colour::kYellow, "Warning"), ": ", warning, "\n");
  }
  return absl::StrCat(text, "\n", AccuracyText(report), VerdictText(report, console));
}

std::string TimeText(const google::protobuf::Timestamp& time) {
  if (time.seconds() == 0) return "";
  return absl::FormatTime("%Y-%m-%d %H:%M:%SZ", absl::FromUnixSeconds(time.seconds()),
                          absl::UTCTimeZone());
}

}  // namespace truepose::cli
