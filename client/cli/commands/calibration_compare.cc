// truepose calibration compare: sessions under several calibrations, as found and as left.
#include <memory>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/cli/commands/commands.h"
#include "client/cli/inputs.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/table.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

constexpr int kDigits = 3;  // as in reports

struct Options {
  std::vector<std::string> calibrations, sessions;
  std::string observe;
};

absl::StatusOr<v1::CompareCalibrationsRequest> RequestOf(const Options& options) {
  v1::CompareCalibrationsRequest request;
  FaultList faults;
  for (const std::string& typed : options.calibrations) {
    const auto name = CalibrationName(typed);
    faults.AddAll(name.status());
    request.add_calibrations(name.value_or(""));
  }
  for (const std::string& typed : options.sessions) request.add_sessions(SessionName(typed));
  const auto observe = ParseObserve(options.observe);
  faults.AddAll(observe.status());
  request.set_observe(observe.value_or(v1::OBSERVE_UNSPECIFIED));
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  return request;
}

void AddRow(const std::string& name, const std::string& when, int rows,
            const v1::PoseStatistics& statistics, Table& table) {
  std::vector<std::string> cells = {name, when, absl::StrCat(rows)};
  const auto add = [&](bool present, const v1::Statistics& of) {
    for (const double value : {of.mean(), of.rms(), of.max()})
      cells.push_back(present ? Fixed(value, kDigits) : "");
  };
  add(statistics.has_position_mm(), statistics.position_mm());
  add(statistics.has_rotation_deg(), statistics.rotation_deg());
  table.Add(std::move(cells));
}

// The first calibration is how the robot was found, the last how it was left.
std::string When(int index, int count) {
  if (count < 2) return "";
  if (index == 0) return "as found";
  return index == count - 1 ? "as left" : "";
}

// One session's evaluations, beginning at `first`.
std::string SessionText(const v1::CompareCalibrationsResponse& response, int first, int count) {
  Table table({{"calibration", Align::kLeft},
               {"", Align::kLeft},
               {"rows"},
               {"mm: mean"},
               {"rms"},
               {"max"},
               {"deg: mean"},
               {"rms"},
               {"max"}});
  std::string warnings;
  const v1::Evaluation& head = response.evaluations(first);
  AddRow("nominal", "", head.set().poses(), head.set().before(), table);
  for (int i = 0; i < count; ++i) {
    const v1::Evaluation& evaluation = response.evaluations(first + i);
    const std::string name = ShortName(evaluation.calibration());
    AddRow(name, When(i, count), evaluation.set().poses(), evaluation.set().after(), table);
    for (const std::string& warning : evaluation.warnings())
      absl::StrAppend(&warnings, "  ", name, ": ", warning, "\n");
  }
  return absl::StrCat("Session ", ShortName(head.session()), "\n", table.Text("  "), warnings);
}

std::string ComparisonText(const v1::CompareCalibrationsResponse& response, int calibrations) {
  std::string text;
  for (int first = 0; first < response.evaluations_size(); first += calibrations) {
    absl::StrAppend(&text, first == 0 ? "" : "\n", SessionText(response, first, calibrations));
  }
  return text;
}

absl::Status Compare(const Invocation& invocation, const Options& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto request, RequestOf(options));
  constexpr char kHint[] =
      "`truepose calibration list` and `truepose session list` show what this server has.";
  return WithServer(invocation, kHint, [&](const client::Client& client) -> absl::Status {
    const auto response = client.CompareCalibrations(request);
    if (!response.ok()) return AsFaultOfInput(response.status());
    return Reply(invocation, *response,
                 [&] { return ComparisonText(*response, request.calibrations_size()); });
  });
}

}  // namespace

void AddCalibrationCompare(const Command& calibration) {
  const auto options = std::make_shared<Options>();
  calibration.Add("compare", "Sessions under several calibrations: as found, as left")
      .Required("CALIBRATION", "", &options->calibrations,
                "From the one that was found to the one that is left: ur10#1 ur10#2")
      .Required("--session", "UUID", &options->sessions, "Sealed sessions of the robot")
      .Option("--observe", "KIND", &options->observe,
              "Use only the pose, point or point_axis; default: all there is")
      .Footer(
          "Base and tool are fitted on each session's own rows.\n\nExample:\n"
          "  truepose calibration compare ur10#1 ur10#2 --session "
          "5f0c2c1e-8a53-4f0e-9a51-6f1f0f1f7a11")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return Compare(invocation, *options); });
}

}  // namespace truepose::cli
