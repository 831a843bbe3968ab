// truepose accuracy-map: what a compensated tool is predicted to reach over a volume.
#include "convert/accuracy_map.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_split.h"
#include "client/cli/accuracy_svg.h"
#include "client/cli/commands/commands.h"
#include "client/cli/commands/table.h"
#include "client/cli/inputs.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/output_file.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/table.h"
#include "client/cli/verdict.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

struct Options {
  bool local = false;
  std::string calibration, robot;
  formats::UrdfEnds ends;
  std::string spec, points, csv, svg;
};

// "13x13x3"; "" is the default.
absl::Status ParsePoints(const std::string& text, v1::AccuracyMapSpec* spec) {
  if (text.empty()) return absl::OkStatus();
  const std::vector<std::string> parts = absl::StrSplit(text, 'x');
  int points[3] = {0, 0, 0};
  bool understood = parts.size() == 3;
  for (size_t i = 0; understood && i < 3; ++i)
    understood = absl::SimpleAtoi(parts[i], &points[i]) && points[i] > 0;
  if (!understood) return OptionFault("--points", text, "such as 13x13x3, along x, y and z");
  spec->set_points_x(points[0]);
  spec->set_points_y(points[1]);
  spec->set_points_z(points[2]);
  return absl::OkStatus();
}

// The file is that of a table, of which the box counts.
absl::StatusOr<v1::AccuracyMapSpec> LoadSpec(const Options& options) {
  TableOptions table;
  table.spec = options.spec;
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::CompensationTableSpec read, LoadTableSpec(table));
  if (!read.has_box())
    return FaultStatus(absl::StrCat(options.spec, ": box"), "none", "a box and reference_joints");
  v1::AccuracyMapSpec spec;
  *spec.mutable_box() = read.box();
  TRUEPOSE_RETURN_IF_ERROR(ParsePoints(options.points, &spec));
  return spec;
}

absl::StatusOr<std::optional<OutputFile>> Open(const std::string& path, const char* option) {
  if (path.empty()) return std::optional<OutputFile>();
  TRUEPOSE_ASSIGN_OR_RETURN(OutputFile file, OutputFile::Create(path, option));
  return std::optional<OutputFile>(std::move(file));
}

std::string Csv(const v1::AccuracyMap& map) {
  std::string text =
      "x_m,y_m,z_m,reached,rms_mm,position_95_mm,parameters_mm,unexplained_mm,repeatability_mm\n";
  for (const v1::AccuracyMapPoint& point : map.points()) {
    absl::StrAppendFormat(&text, "%.9g,%.9g,%.9g,%d", point.x_m(), point.y_m(), point.z_m(),
                          point.reached() ? 1 : 0);
    if (point.reached())
      absl::StrAppendFormat(&text, ",%.6g,%.6g,%.6g,%.6g,%.6g\n", point.rms_mm(),
                            point.position_95_mm(), point.parameters_mm(), point.unexplained_mm(),
                            point.repeatability_mm());
    else
      absl::StrAppend(&text, ",,,,,\n");
  }
  return text;
}

std::string Text(const v1::AccuracyMap& map) {
  Table table({{"predicted position error", Align::kLeft}, {"mm"}});
  table.Add({"root mean square", Fixed(map.rms_mm(), 3)});
  table.Add({"95 % below, all points", Fixed(map.position_95_mm(), 3)});
  table.Add({"95 % below, best point", Fixed(map.best_95_mm(), 3)});
  table.Add({"95 % below, worst point", Fixed(map.worst_95_mm(), 3)});
  return absl::StrCat(table.Text(), map.reached(), " of ", Count(map.points_size(), "point"),
                      " reached in the configuration of the reference joints\n");
}

std::string Title(const v1::AccuracyMap& map, const std::string& calibration) {
  return absl::StrCat("Predicted accuracy of the compensated tool: ", ShortName(map.robot()),
                      ", calibration ", ShortName(calibration));
}

const Renaming& Fields() {
  static const Renaming kFields = {
      {"calibration.", "--calibration: "}, {"box", "--spec: box"}, {"points", "--points"}};
  return kFields;
}

absl::Status Deliver(const Invocation& invocation, const Options& options, const std::string& robot,
                     const v1::Nominal& nominal, const v1::Calibration& calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::AccuracyMapSpec spec, LoadSpec(options));
  TRUEPOSE_ASSIGN_OR_RETURN(std::optional<OutputFile> csv, Open(options.csv, "--csv"));
  TRUEPOSE_ASSIGN_OR_RETURN(std::optional<OutputFile> svg, Open(options.svg, "--svg"));
  auto map = convert::RunAccuracyMap(nominal, calibration, spec);
  if (!map.ok()) return AsFaultOfInput(RenameFields(map.status(), Fields()));
  WarnOfVerdict(invocation.console, calibration.report());
  map->set_robot(robot);
  if (csv) TRUEPOSE_RETURN_IF_ERROR(csv->Commit(Csv(*map)));
  if (svg)
    TRUEPOSE_RETURN_IF_ERROR(svg->Commit(AccuracySvg(*map, Title(*map, options.calibration))));
  return Reply(invocation, *map, [&] { return Text(*map); });
}

absl::Status MapLocally(const Invocation& invocation, const Options& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const LocalCalibration local,
                            LoadLocalCalibration(options.robot, options.ends, options.calibration));
  return Deliver(invocation, options, RobotName(local.robot.robot_id), local.robot.nominal,
                 local.calibration);
}

absl::Status MapFromServer(const Invocation& invocation, const Options& options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckNoEnds(options.ends));
  if (!options.robot.empty())
    return UsageError("--robot is for --local; on a server the calibration knows its robot");
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string name, CalibrationName(options.calibration));
  return WithServer(
      invocation, kCalibrationHint, [&](const client::Client& client) -> absl::Status {
        TRUEPOSE_ASSIGN_OR_RETURN(const CalibratedRobot robot, GetCalibratedRobot(client, name));
        return Deliver(invocation, options, RobotOf(name), robot.nominal, robot.calibration);
      });
}

}  // namespace

void AddAccuracyMap(const Command& root) {
  const auto options = std::make_shared<Options>();
  root.Add("accuracy-map", "Predict the accuracy of a compensated tool over a volume")
      .Required("--calibration", "NAME|FILE", &options->calibration,
                "Such as ur10#1; with --local a file")
      .Required("--spec", "FILE", &options->spec,
                "A table's spec, of which the box counts, as YAML or JSON (docs/compensation.md)")
      .Option("--points", "NxNxN", &options->points,
              "Points along x, y and z of the box; default 13x13x3")
      .Option("--local", "", &options->local, "Work here, from files, without a server")
      .Option("--robot", "FILE", &options->robot, "With --local: the robot file")
      .Option("--urdf-base", "LINK", &options->ends.base, kUrdfBaseHelp)
      .Option("--urdf-tip", "LINK", &options->ends.tip, kUrdfTipHelp)
      .Option("--csv", "FILE", &options->csv, "Write the points as CSV")
      .Option("--svg", "FILE", &options->svg, "Write a picture, a slice for each height")
      .Footer(
          "The tool's z axis is the approach of the box everywhere.\n\nExamples:\n"
          "  truepose accuracy-map --calibration ur10#1 --spec cell.yaml --svg map.svg\n"
          "  truepose accuracy-map --local --robot ur10.yaml --calibration ur10.json --spec "
          "cell.yaml --csv map.csv")
      .Run(Command::Reach::kRemote, [options](const Invocation& invocation) {
        return options->local ? MapLocally(invocation, *options)
                              : MapFromServer(invocation, *options);
      });
}

}  // namespace truepose::cli
