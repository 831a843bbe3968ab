// truepose table show and verify: a file that is there.
#include <filesystem>
#include <memory>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/cli/commands/table.h"
#include "client/cli/commands/table_names.h"
#include "client/cli/commands/table_remote.h"
#include "client/cli/reply.h"
#include "client/cli/same_robot.h"
#include "client/cli/table.h"
#include "client/cli/table_text.h"
#include "convert/table_header.h"
#include "convert/table_verify.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

struct VerifyOptions {
  std::string table, calibration, robot;
  formats::UrdfEnds ends;
  int points = 10000;
  unsigned long long seed = 2;
};

absl::Status Show(const Invocation& invocation, const std::string& path) {
  TRUEPOSE_ASSIGN_OR_RETURN(const compensation::TableFile file, LoadTable(path));
  const v1::CompensationTableHeader header = convert::HeaderToProto(file.table());
  return Reply(invocation, header, [&] { return TableText(header); });
}

// Names on a server have no dot.
bool IsFile(const std::string& typed) {
  std::error_code error;
  return typed.find('.') != std::string::npos || std::filesystem::is_regular_file(typed, error);
}

std::string Millimetres(double length_m) { return Fixed(1e3 * length_m, 4); }
std::string Degrees(double angle_rad) { return Fixed(57.29577951308232 * angle_rad, 5); }

std::string Text(const v1::TableVerification& verified, const v1::CompensationTableHeader& header) {
  Table table({{"error", Align::kLeft}, {"position mm"}, {"orientation deg"}});
  table.Add({"stated worst", Millimetres(header.verified().worst_position_m()),
             Degrees(header.verified().worst_rotation_rad())});
  table.Add({"found worst", Millimetres(verified.error().worst_position_m()),
             Degrees(verified.error().worst_rotation_rad())});
  table.Add({"found 95 %", Millimetres(verified.error().position_95_m()),
             Degrees(verified.error().rotation_95_rad())});
  return absl::StrCat(table.Text(), Count(verified.points(), "point"), " corrected; of ",
                      verified.drawn(), " drawn ones refused: ", verified.near_singular(),
                      " near a singularity, ", verified.beyond_limit(), " beyond a joint limit, ",
                      verified.outside_domain(), " outside the domain\n");
}

absl::Status Verify(const Invocation& invocation, const VerifyOptions& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const compensation::TableFile file, LoadTable(options.table));
  TRUEPOSE_ASSIGN_OR_RETURN(const LocalCalibration local,
                            LoadLocalCalibration(options.robot, options.ends, options.calibration));
  TRUEPOSE_RETURN_IF_ERROR(
      CheckSameRobot({options.table, "a table", std::string(file.table().header.robot.view())},
                     local.robot, options.robot));
  const auto verified = convert::RunTableVerification(
      file.table(), local.robot.nominal, local.calibration, {options.points, options.seed});
  if (!verified.ok())
    return AsFaultOfInput(RenameFields(
        verified.status(),
        {{"table", options.table}, {"calibration.", "--against: "}, {"points", "--points"}}));
  const v1::CompensationTableHeader header = convert::HeaderToProto(file.table());
  TRUEPOSE_RETURN_IF_ERROR(Reply(invocation, *verified, [&] { return Text(*verified, header); }));
  if (verified->within_stated()) return absl::OkStatus();
  return AnsweredFailure("the table is off by more than its header states");
}

}  // namespace

void AddTableShow(const Command& table) {
  const auto path = std::make_shared<std::string>();
  table.Add("show", "What a table is for, and how well it was verified")
      .Required("TABLE", "", path.get(), absl::StrCat("A file; else on a server ", kOneTable))
      .Footer(
          "Examples:\n  truepose table show ur10.tpct\n  truepose table show ur10.tpct --json\n"
          "  truepose table show ur10")
      .Run(Command::Reach::kRemote, [path](const Invocation& invocation) {
        return IsFile(*path) ? Show(invocation, *path) : ShowTableOnServer(invocation, *path);
      });
}

void AddTableVerify(const Command& table) {
  const auto options = std::make_shared<VerifyOptions>();
  table.Add("verify", "Measure a table's error again, at other points")
      .Required("TABLE", "", &options->table, "File")
      .Required("--against", "FILE", &options->calibration, "The calibration that it holds")
      .Required("--robot", "FILE", &options->robot, "The robot file")
      .Option("--urdf-base", "LINK", &options->ends.base, kUrdfBaseHelp)
      .Option("--urdf-tip", "LINK", &options->ends.tip, kUrdfTipHelp)
      .Option("--points", "N", &options->points, "Points to draw, 1000 or more; default 10000")
      .Option("--seed", "N", &options->seed, "Of the points; default 2")
      .Footer(
          "Exit code 1 when a point is off by more than the header states.\n\nExamples:\n"
          "  truepose table verify ur10.tpct --against ur10.json --robot ur10.yaml\n"
          "  truepose table verify ur10.tpct --against ur10.json --robot ur10.yaml --points 100000 "
          "--seed 7")
      .Run(Command::Reach::kLocal,
           [options](const Invocation& invocation) { return Verify(invocation, *options); });
}

}  // namespace truepose::cli
