// truepose program correct: robot programs in, the same programs with corrected joint targets out.
#include <memory>
#include <numbers>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/cli/commands/commands.h"
#include "client/cli/inputs.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/output_file.h"
#include "client/cli/program_correction.h"
#include "client/cli/program_reply.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/same_file.h"
#include "client/cli/verdict.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "formats/text_file.h"
#include "programs/correct.h"
#include "programs/dialect.h"
#include "programs/mark.h"

namespace truepose::cli {
namespace {

// Programs that a robot's memory holds are far smaller.
constexpr size_t kMostBytes = 32 << 20;

struct Options {
  bool local = false, keep_uncorrected = false, diff = false, again = false;
  std::string program, dialect, calibration, table, robot, output;
  formats::UrdfEnds ends;
  double largest_change_deg = 5.0;
};

absl::StatusOr<programs::Dialect> DialectOf(const Options& options) {
  const std::string kNames = "urscript, krl or rapid";
  if (options.dialect.empty()) {
    if (const auto dialect = programs::DialectOfFile(options.program)) return *dialect;
    return OptionFault("PROGRAM", options.program,
                       "an extension that tells the dialect, or --dialect " + kNames);
  }
  if (const auto dialect = programs::DialectNamed(options.dialect)) return *dialect;
  return OptionFault("--dialect", options.dialect, kNames);
}

absl::StatusOr<programs::CorrectOptions> CorrectOptionsOf(const Options& options) {
  if (!(options.largest_change_deg > 0.0))
    return OptionFault("--largest-change", absl::StrCat(options.largest_change_deg), "above 0");
  return programs::CorrectOptions{
      .keep_uncorrected = options.keep_uncorrected,
      .largest_change_rad = options.largest_change_deg * std::numbers::pi / 180.0};
}

// What is corrected twice is off by the correction.
absl::Status CheckNotCorrected(const Options& options, const ProgramFiles& files) {
  const auto mark = programs::FindMark(files.before, files.dialect);
  if (!mark.has_value() || options.again) return absl::OkStatus();
  return FaultStatus(
      absl::StrCat(options.program, ":", mark->line),
      absl::StrCat("a program that was corrected already, by calibration ", mark->calibration),
      "the original program; or --again, which adds this correction to that one");
}

absl::StatusOr<ProgramFiles> LoadProgram(const Options& options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckOtherFile(options.program, options.output, "--output"));
  ProgramFiles files{options.program, options.output, {}, "", options.diff};
  TRUEPOSE_ASSIGN_OR_RETURN(files.dialect, DialectOf(options));
  absl::StatusOr<std::string> text = formats::ReadTextFile(options.program, kMostBytes);
  if (!text.ok()) return AsInputFault(text.status());
  files.before = *std::move(text);
  TRUEPOSE_RETURN_IF_ERROR(CheckNotCorrected(options, files));
  return files;
}

// What a person may take for corrected although it is not.
void WarnOfRest(const Console& console, const programs::CorrectedProgram& corrected) {
  if (corrected.changes.empty()) {
    Warn(console, "no joint target was corrected: the output is a copy of the input");
  } else if (!corrected.uncorrected.empty()) {
    Warn(console, "some targets stay uncorrected: the program mixes corrected and nominal motions");
  }
}

absl::Status CorrectFile(const Invocation& invocation, const Options& options,
                         const ProgramFiles& files, const ProgramCorrection& correction) {
  TRUEPOSE_ASSIGN_OR_RETURN(programs::CorrectOptions limits, CorrectOptionsOf(options));
  limits.calibration = correction.calibration;
  TRUEPOSE_ASSIGN_OR_RETURN(OutputFile output, OutputFile::Create(options.output, "--output"));
  TRUEPOSE_ASSIGN_OR_RETURN(
      const programs::CorrectedProgram corrected,
      programs::CorrectProgram(files.before, files.input, files.dialect, correction.prismatic,
                               correction.correct, limits));
  TRUEPOSE_RETURN_IF_ERROR(output.Commit(corrected.text));
  WarnOfRest(invocation.console, corrected);
  return Reply(invocation, ProgramJson(files, corrected),
               [&] { return ProgramText(files, corrected); });
}

absl::Status CorrectLocally(const Invocation& invocation, const Options& options) {
  if (options.robot.empty()) return UsageError("--local needs --robot FILE");
  TRUEPOSE_ASSIGN_OR_RETURN(const ProgramFiles files, LoadProgram(options));
  TRUEPOSE_ASSIGN_OR_RETURN(const LocalCalibration local,
                            LoadLocalCalibration(options.robot, options.ends, options.calibration));
  TRUEPOSE_ASSIGN_OR_RETURN(const ProgramCorrection correction,
                            LocalCorrection(local.robot.nominal, local.calibration));
  WarnOfVerdict(invocation.console, local.calibration.report());
  return CorrectFile(invocation, options, files, correction);
}

absl::Status CorrectOnServer(const Invocation& invocation, const Options& options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckNoEnds(options.ends));
  if (!options.robot.empty())
    return UsageError("--robot is for --local; on a server the calibration knows its robot");
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string name, CalibrationName(options.calibration));
  TRUEPOSE_ASSIGN_OR_RETURN(const ProgramFiles files, LoadProgram(options));
  return WithServer(
      invocation, kCalibrationHint, [&](const client::Client& client) -> absl::Status {
        TRUEPOSE_ASSIGN_OR_RETURN(const CalibratedRobot robot, GetCalibratedRobot(client, name));
        TRUEPOSE_ASSIGN_OR_RETURN(const ProgramCorrection correction,
                                  RemoteCorrection(client, robot.nominal, robot.calibration));
        WarnOfVerdict(invocation.console, robot.calibration.report());
        return CorrectFile(invocation, options, files, correction);
      });
}

absl::Status CorrectWithTable(const Invocation& invocation, const Options& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const ProgramFiles files, LoadProgram(options));
  TableRobot robot;
  robot.path = options.robot;
  if (!options.robot.empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(robot.file, LoadRobot(options.robot, options.ends));
  }
  TRUEPOSE_ASSIGN_OR_RETURN(
      const ProgramCorrection correction,
      TableCorrection(options.table, options.robot.empty() ? nullptr : &robot));
  return CorrectFile(invocation, options, files, correction);
}

absl::Status Correct(const Invocation& invocation, const Options& options) {
  if (options.table.empty() == options.calibration.empty())
    return UsageError("give --calibration or --table, and not both");
  if (!options.table.empty()) return CorrectWithTable(invocation, options);
  const auto correct = options.local ? CorrectLocally : CorrectOnServer;
  return AsFaultOfVerdict(
      RenameFields(correct(invocation, options), {{"calibration.", "--calibration: "}}));
}

constexpr char kFooter[] =
    "Only the numbers of joint targets change, and a comment line at the top says so; all else "
    "stays\n"
    "byte for byte. Poses, calculated targets and whatever else was not understood are listed\n"
    "(docs/programs.md). A target that can't be corrected, and a program that was corrected "
    "before,\n"
    "is refused: no file is written.\n\nExamples:\n"
    "  truepose program correct weld.src --calibration kr10#3 --output corrected/weld.src --diff\n"
    "  truepose program correct pick.script --local --robot ur10.yaml --calibration ur10.json \\\n"
    "      --output pick_corrected.script\n"
    "  truepose program correct cell.mod --table irb.tpct --output corrected/cell.mod";

void AddCorrect(const Command& program) {
  const auto options = std::make_shared<Options>();
  program.Add("correct", "Correct the joint targets of a robot program")
      .Required("PROGRAM", "", &options->program, "URScript, KRL or RAPID")
      .Option("--dialect", "NAME", &options->dialect,
              "urscript, krl or rapid; default: by the extension")
      .Option("--local", "", &options->local, "Compute here, from files, without a server")
      .Option("--calibration", "NAME|FILE", &options->calibration,
              "Such as ur10#1; with --local a file")
      .Option("--table", "FILE", &options->table,
              "A compensation table instead of a calibration; needs no server")
      .Option("--robot", "FILE", &options->robot,
              "With --local: the robot file. With --table: the robot it has to be of")
      .Option("--urdf-base", "LINK", &options->ends.base, kUrdfBaseHelp)
      .Option("--urdf-tip", "LINK", &options->ends.tip, kUrdfTipHelp)
      .Required("--output", "FILE", &options->output,
                "The corrected program; never the input itself")
      .Option("--diff", "", &options->diff, "Show what changed, as a unified diff")
      .Option("--keep-uncorrected", "", &options->keep_uncorrected,
              "Leave and list targets that can't be corrected instead of refusing the program")
      .Option("--again", "", &options->again,
              "Also a program that says that it was corrected already")
      .Option("--largest-change", "DEG", &options->largest_change_deg,
              "A joint may change by so much; more means a singularity. Default 5")
      .Footer(kFooter)
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return Correct(invocation, *options); });
}

}  // namespace

void AddProgram(const Command& root) {
  AddCorrect(root.Add("program", "Robot programs: correct their joint targets"));
}

}  // namespace truepose::cli
