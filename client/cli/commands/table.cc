// truepose table: compensation tables, the form of a calibration that a controller uses.
#include "client/cli/commands/table.h"

#include <algorithm>
#include <utility>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "client/cli/commands/commands.h"
#include "client/cli/commands/table_remote.h"
#include "client/cli/names.h"
#include "client/cli/table.h"
#include "client/cli/table_fault.h"
#include "client/cli/written_units.h"
#include "convert/table_spec.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "formats/message_file.h"

namespace truepose::cli {
namespace {

absl::StatusOr<std::vector<std::pair<std::string, std::string>>> SplitSets(
    const std::vector<std::string>& sets) {
  std::vector<std::pair<std::string, std::string>> fields;
  FaultList faults;
  for (const std::string& set : sets) {
    const size_t equals = set.find('=');
    if (equals == std::string::npos)
      faults.Add("--set", absl::StrCat("'", set, "'"), "KEY=VALUE");
    else
      fields.emplace_back(set.substr(0, equals), set.substr(equals + 1));
  }
  if (!faults.empty()) return faults.ToStatus();
  return fields;
}

}  // namespace

const char kTableSpecHelp[] =
    "Keys of --spec and --set, each with its default: position_tolerance_mm 0.02,\n"
    "rotation_tolerance_deg 0.005, smallest_singular_value 0.05, verification_points 10000,\n"
    "largest_bytes 67108864, seed 0; and one domain, else the robot's joint limits:\n"
    "joint_ranges.joints, a list of {lower, upper} in rad or m, or box with min_x_mm, max_x_mm\n"
    "and so on, tool, approach_x, approach_y, approach_z, cone_deg, reference_joints (rad, m),\n"
    "min_roll_deg, max_roll_deg. Lists only in the file.\n";

void AddTableSpecOptions(const Command& command, TableOptions* options) {
  command
      .Option("--spec", "FILE", &options->spec,
              "Domain and tolerances as YAML or JSON (docs/compensation.md)")
      .Option("--set", "KEY=VALUE", &options->set, "Fields one by one, over those of the file");
}

absl::Status CheckTableSpec(const v1::CompensationTableSpec& spec,
                            const formats::GivenFields& given, const std::string& place) {
  const auto has = [&](absl::string_view begin) {
    return std::any_of(given.paths.begin(), given.paths.end(),
                       [&](const std::string& field) { return absl::StartsWith(field, begin); });
  };
  FaultList faults;
  if (has("box.") && has("joint_ranges"))
    faults.Add(place + "joint_ranges", "given beside box", "one domain: a box or joint ranges");
  faults.AddAll(InWrittenUnits(convert::ValidateTableSpec(spec), given), place);
  return faults.ToStatus();
}

absl::StatusOr<v1::CompensationTableSpec> LoadTableSpec(const TableOptions& options) {
  v1::CompensationTableSpec spec;
  formats::GivenFields given;
  if (!options.spec.empty()) {
    const absl::Status read = formats::ReadMessageFile(options.spec, spec, given);
    if (!read.ok()) return AsInputFault(read);
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const auto fields, SplitSets(options.set));
  TRUEPOSE_RETURN_IF_ERROR(formats::SetMessageFields(fields, "--set", spec, given));
  TRUEPOSE_RETURN_IF_ERROR(CheckTableSpec(spec, given, SpecPlace(options)));
  return spec;
}

absl::StatusOr<v1::CompensationTableInput> LoadTableInput(const TableOptions& options) {
  if (options.calibration.empty()) return UsageError("--local needs --calibration FILE");
  TRUEPOSE_ASSIGN_OR_RETURN(LocalCalibration local,
                            LoadLocalCalibration(options.robot, options.ends, options.calibration));
  v1::CompensationTableInput input;
  TRUEPOSE_ASSIGN_OR_RETURN(*input.mutable_spec(), LoadTableSpec(options));
  input.set_robot(RobotName(local.robot.robot_id));
  *input.mutable_nominal() = local.robot.nominal;
  *input.mutable_calibration() = std::move(local.calibration);
  return input;
}

std::string SpecPlace(const TableOptions& options) {
  return options.spec.empty() ? "--set: " : "--spec: ";
}

Renaming TableFields(const std::string& place) {
  Renaming fields = {{"calibration.", "--calibration: "}, {"points", "--points"}};
  for (const char* field : {"joint_ranges", "box", "position_tolerance_m", "rotation_tolerance_rad",
                            "smallest_singular_value", "verification_points", "largest_bytes"})
    fields.emplace_back(field, absl::StrCat(place, field));
  return fields;
}

absl::StatusOr<compensation::TableFile> LoadTable(const std::string& path) {
  compensation::TableFile file;
  const compensation::TableReport report = compensation::TableFile::Map(path.c_str(), {}, &file);
  if (!report.ok()) return TableFaultStatus(report, path, path);
  return file;
}

std::string EstimateText(const v1::CompensationTableEstimate& estimate) {
  return absl::StrCat(absl::StrJoin(estimate.nodes(), " x "), " nodes, ",
                      Fixed(static_cast<double>(estimate.size_bytes()) / (1 << 20), 2),
                      " MB; worst error estimated ", Fixed(1e3 * estimate.position_m(), 4), " mm, ",
                      Fixed(estimate.rotation_rad() * 57.29577951308232, 5), " deg\n");
}

void AddTable(const Command& root) {
  const Command table = root.Add("table", "Build, look at and check compensation tables");
  AddTableEstimate(table);
  AddTableBuild(table);
  AddTableShow(table);
  AddTableVerify(table);
  AddTableExport(table);
  AddTableOnServer(table);
}

}  // namespace truepose::cli
