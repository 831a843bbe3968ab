#include "client/cli/export.h"

#include <memory>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/cli/console.h"
#include "client/cli/outcome.h"
#include "client/cli/output_file.h"
#include "client/cli/reply.h"
#include "convert/export.h"
#include "core/base/status_macros.h"
#include "formats/dh_table.h"
#include "formats/ur_calibration.h"
#include "formats/urdf.h"

namespace truepose::cli {
namespace {

struct Exported {
  std::string text;
  std::unique_ptr<google::protobuf::Message> message;
  std::vector<std::string> warnings;
};

template <class Message>
Exported Of(std::string text, const Message& message, std::vector<std::string> warnings) {
  return {std::move(text), std::make_unique<Message>(message), std::move(warnings)};
}

absl::StatusOr<Exported> AsUrdf(const formats::RobotFile& robot,
                                const v1::Calibration* calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const convert::ExportedRobot exported,
                            convert::ExportJointFrames(robot.nominal, calibration));
  TRUEPOSE_ASSIGN_OR_RETURN(std::string text, formats::WriteUrdf({robot.robot_id, exported.nominal,
                                                                  formats::FieldLines()}));
  return Of(std::move(text), exported.nominal, exported.warnings);
}

absl::StatusOr<Exported> AsDhTable(const formats::RobotFile& robot,
                                   const v1::Calibration* calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const convert::ExportedDh exported,
                            convert::ExportDhTable(robot.nominal, calibration));
  return Of(formats::WriteDhTable(robot.nominal, exported.table), exported.table,
            exported.warnings);
}

absl::StatusOr<Exported> AsRobotFile(const formats::RobotFile& robot,
                                     const v1::Calibration* calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const convert::ExportedRobot exported,
                            convert::ExportRobot(robot.nominal, calibration));
  return Of(formats::WriteRobotFile({robot.robot_id, exported.nominal, formats::FieldLines()}),
            exported.nominal, exported.warnings);
}

absl::StatusOr<Exported> AsUrCalibration(const formats::RobotFile& robot,
                                         const v1::Calibration* calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const convert::ExportedRobot exported,
                            convert::ExportUrCalibration(robot.nominal, calibration));
  TRUEPOSE_ASSIGN_OR_RETURN(
      std::string text, formats::WriteUrCalibration({exported.nominal.geometry(),
                                                     convert::UrHash(robot.nominal, calibration)}));
  return Of(std::move(text), exported.nominal, exported.warnings);
}

using Writer = absl::StatusOr<Exported> (*)(const formats::RobotFile&, const v1::Calibration*);

Writer WriterOf(const std::string& format) {
  if (format == "urdf") return AsUrdf;
  if (format == "dh") return AsDhTable;
  if (format == "robot") return AsRobotFile;
  return format == "ur_calibration" ? AsUrCalibration : nullptr;
}

absl::Status WriteFile(const std::string& text, const std::string& path) {
  if (path.empty()) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(OutputFile file, OutputFile::Create(path, "--output"));
  return file.Commit(text);
}

}  // namespace

void AddExportOptions(const Command& command, ExportOptions* options) {
  command
      .Required("--format", "FORMAT", &options->format,
                "urdf, dh (table as CSV), robot (our YAML) or ur_calibration")
      .Option("-o,--output", "FILE", &options->output, "Default: standard output");
}

absl::Status CheckFormat(const ExportOptions& options) {
  if (WriterOf(options.format) != nullptr) return absl::OkStatus();
  return OptionFault("--format", options.format, "urdf, dh, robot or ur_calibration");
}

absl::Status Export(const Invocation& invocation, const ExportOptions& options,
                    const formats::RobotFile& robot, const v1::Calibration* calibration) {
  TRUEPOSE_RETURN_IF_ERROR(CheckFormat(options));
  TRUEPOSE_ASSIGN_OR_RETURN(const Exported exported, WriterOf(options.format)(robot, calibration));
  for (const std::string& warning : exported.warnings) Warn(invocation.console, warning);
  TRUEPOSE_RETURN_IF_ERROR(WriteFile(exported.text, options.output));
  return Reply(invocation, *exported.message, [&] {
    return options.output.empty()
               ? exported.text
               : absl::StrCat(options.format, " of ", robot.robot_id, " in ", options.output, "\n");
  });
}

}  // namespace truepose::cli
