// truepose simulate: a session with stated errors and noise, of any robot.
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/cli/commands/commands.h"
#include "client/cli/inputs.h"
#include "client/cli/json.h"
#include "client/cli/outcome.h"
#include "client/cli/output_file.h"
#include "client/cli/reply.h"
#include "client/cli/table.h"
#include "convert/run.h"
#include "core/base/status_macros.h"
#include "formats/session_file.h"

namespace truepose::cli {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

// In the units of the command line.
struct Options {
  std::string robot, output, truth;
  bool measuring_robot = false;
  int poses = 100;
  unsigned long long seed = 1;
  double length_error_mm = 0.5;
  double angle_error_deg = 0.03;
  double noise_mm = 0.05;
  double noise_deg = 0.006;
  double joint_noise_deg = 0.0;
  double encoder_resolution_deg = 0.0;
  formats::UrdfEnds ends;
};

convert::SimulationOptions InSiUnits(const Options& options) {
  convert::SimulationOptions simulation;
  simulation.poses = options.poses;
  simulation.seed = options.seed;
  simulation.length_error_sd_m = 1e-3 * options.length_error_mm;
  simulation.angle_error_sd_rad = kRadians * options.angle_error_deg;
  simulation.position_noise_sd_m = 1e-3 * options.noise_mm;
  simulation.rotation_noise_sd_rad = kRadians * options.noise_deg;
  simulation.joint_noise_sd = kRadians * options.joint_noise_deg;
  simulation.encoder_resolution = kRadians * options.encoder_resolution_deg;
  return simulation;
}

// The core speaks of SI figures.
absl::Status AsTyped(const absl::Status& status) {
  return RenameFields(status, {{"poses", "--poses"},
                               {"length_error_sd_m", "--length-error-mm (in m)"},
                               {"angle_error_sd_rad", "--angle-error-deg (in rad)"},
                               {"position_noise_sd_m", "--noise-mm (in m)"},
                               {"rotation_noise_sd_rad", "--noise-deg (in rad)"},
                               {"joint_noise_sd", "--joint-noise-deg (in rad)"},
                               {"encoder_resolution", "--encoder-resolution-deg (in rad)"}});
}

absl::StatusOr<formats::RobotFile> RobotToSimulate(const Options& options) {
  if (options.robot.empty() != options.measuring_robot) {
    return UsageError("simulate needs a robot: either FILE or --measuring-robot");
  }
  if (options.measuring_robot)
    return formats::RobotFile{"", convert::MeasuringRobot(), formats::FieldLines()};
  return LoadRobot(options.robot, options.ends);
}

v1::FrameEstimate Frame(v1::ParameterGroup group, const v1::Pose& pose) {
  v1::FrameEstimate frame;
  frame.set_group(group);
  *frame.mutable_pose() = pose;
  return frame;
}

// The truth has the form of a calibration, so that `evaluate --local` and `compensate --local` take
// it.
v1::Calibration Truth(const formats::RobotFile& robot, const convert::Simulation& simulation) {
  v1::Calibration truth;
  truth.set_nominal_revision(LocalRevision(robot));
  for (const v1::InternalParameter& parameter : simulation.truth)
    *truth.add_internal_parameters() = parameter;
  truth.mutable_report()->set_convention(simulation.convention);
  *truth.mutable_report()->add_frames() = Frame(v1::BASE, simulation.X_MB);
  *truth.mutable_report()->add_frames() = Frame(v1::TOOL, simulation.X_FT);
  return truth;
}

absl::StatusOr<std::optional<OutputFile>> Open(const std::string& path, const std::string& option) {
  if (path.empty()) return std::optional<OutputFile>();
  TRUEPOSE_ASSIGN_OR_RETURN(OutputFile file, OutputFile::Create(path, option));
  return std::optional<OutputFile>(std::move(file));
}

absl::Status WriteFiles(const Options& options, const formats::RobotFile& robot,
                        const convert::Simulation& simulation, const std::string& csv) {
  TRUEPOSE_ASSIGN_OR_RETURN(std::optional<OutputFile> output, Open(options.output, "--output"));
  TRUEPOSE_ASSIGN_OR_RETURN(std::optional<OutputFile> truth, Open(options.truth, "--truth"));
  if (output.has_value()) TRUEPOSE_RETURN_IF_ERROR(output->Commit(csv));
  if (!truth.has_value()) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string json,
                            ToJson(Truth(robot, simulation), /*pretty=*/true));
  return truth->Commit(json);
}

std::string Text(const Options& options, const convert::Simulation& simulation,
                 const std::string& csv) {
  if (options.output.empty()) return csv;
  return absl::StrCat(
      Count(simulation.session.readings_size(), "pose"), " in ", options.output,
      options.truth.empty() ? "" : ", the truth in ", options.truth,
      "\nNext: truepose calibrate --local --robot ",
      options.robot.empty() ? "deploy/examples/measuring_robot.yaml" : options.robot, " --session ",
      options.output, " --split even-odd\n");
}

absl::Status Simulate(const Invocation& invocation, const Options& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const formats::RobotFile robot, RobotToSimulate(options));
  const absl::StatusOr<convert::Simulation> simulation =
      convert::RunSimulation(robot.nominal, InSiUnits(options));
  if (!simulation.ok()) return AsTyped(simulation.status());
  const auto& readings = simulation->session.readings();
  const std::string csv = formats::WriteSessionFile(robot.nominal, simulation->session.session(),
                                                    {readings.begin(), readings.end()});
  TRUEPOSE_RETURN_IF_ERROR(WriteFiles(options, robot, *simulation, csv));
  return Reply(invocation, simulation->session, [&] { return Text(options, *simulation, csv); });
}

void AddFigures(const Command& simulate, Options* options) {
  simulate.Option("--poses", "N", &options->poses, "Rows of the session")
      .Option("--length-error-mm", "SD", &options->length_error_mm,
              "Drawn for each internal length")
      .Option("--angle-error-deg", "SD", &options->angle_error_deg, "Drawn for each internal angle")
      .Option("--noise-mm", "SD", &options->noise_mm, "Of the measured position, per axis")
      .Option("--noise-deg", "SD", &options->noise_deg, "Of the measured orientation, per axis")
      .Option("--joint-noise-deg", "SD", &options->joint_noise_deg, "Of the joint readings")
      .Option("--encoder-resolution-deg", "STEP", &options->encoder_resolution_deg,
              "Joint readings are multiples of this; 0: any")
      .Option("--seed", "N", &options->seed, "Equal seeds give equal files");
}

}  // namespace

void AddSimulate(const Command& root) {
  const auto options = std::make_shared<Options>();
  const Command simulate = root.Add("simulate", "Make a session of a robot with known errors");
  simulate.Option("FILE", "", &options->robot, "Robot file")
      .Option("--measuring-robot", "", &options->measuring_robot,
              "The built-in measuring arm of five joints");
  AddFigures(simulate, options.get());
  simulate.Option("--urdf-base", "LINK", &options->ends.base, kUrdfBaseHelp)
      .Option("--urdf-tip", "LINK", &options->ends.tip, kUrdfTipHelp)
      .Option("--output", "FILE", &options->output, "The session as CSV; default: standard output")
      .Option("--truth", "FILE", &options->truth,
              "Also write the errors that were drawn, as a calibration in JSON")
      .Footer(
          "Standard deviations of prismatic joints are taken as rad = m.\n\nExamples:\n"
          "  truepose simulate ur10.yaml --poses 200 --seed 7 --output session.csv --truth "
          "truth.json\n"
          "  truepose simulate --measuring-robot --noise-mm 0.02 --output session.csv")
      .Run(Command::Reach::kLocal,
           [options](const Invocation& invocation) { return Simulate(invocation, *options); });
}

}  // namespace truepose::cli
