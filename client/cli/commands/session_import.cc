// truepose session import: a file becomes a sealed session.
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "client/append_readings.h"
#include "client/cli/commands/commands.h"
#include "client/cli/inputs.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/progress.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/table.h"
#include "convert/run.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

struct Options {
  std::string file;
  std::string robot;
  std::string euler;
  std::string display_name;
  std::string session_id;
  std::string instrument, placement, operator_name, temperature;
  bool strict_limits = false;
};

// "lt-1" or "instruments/lt-1": the whole name.
std::string Whole(const std::string& collection, const std::string& name) {
  return name.empty() || absl::StrContains(name, '/') ? name : absl::StrCat(collection, "/", name);
}

// What was said of the measurement, and no file has.
absl::Status Describe(const Options& options, v1::Session& session) {
  session.set_instrument(Whole("instruments", options.instrument));
  session.set_placement(Whole(absl::StrCat(session.robot(), "/placements"), options.placement));
  session.set_operator_(options.operator_name);
  double temperature = 0;
  if (options.temperature.empty()) return absl::OkStatus();
  if (!absl::SimpleAtod(options.temperature, &temperature) || std::abs(temperature) > 100)
    return OptionFault("--temperature", options.temperature, "the air at the robot, in deg C");
  session.set_temperature_c(temperature);
  return absl::OkStatus();
}

// The file is read completely, and every fault of it found, before the server hears of a session.
absl::StatusOr<v1::SessionInput> Load(const Invocation& invocation, const Options& options,
                                      const client::Client& client) {
  v1::GetRobotRequest request;
  request.set_name(RobotName(options.robot));
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot, client.GetRobot(request));
  const v1::Nominal& nominal = robot.nominal_revision().nominal();
  TRUEPOSE_ASSIGN_OR_RETURN(
      std::vector<v1::SessionInput> sessions,
      LoadSessions({options.file}, nominal, {options.euler}, invocation.console));
  TRUEPOSE_RETURN_IF_ERROR(
      CheckLimits(nominal, sessions[0], options.strict_limits, invocation.console));
  v1::Session& session = *sessions[0].mutable_session();
  session.set_robot(robot.name());
  session.set_display_name(options.display_name.empty() ? session.source() : options.display_name);
  TRUEPOSE_RETURN_IF_ERROR(Describe(options, session));
  return std::move(sessions[0]);
}

absl::StatusOr<v1::Session> Create(const client::Client& client, const std::string& id,
                                   v1::Session session) {
  session.clear_name();
  session.clear_reading_count();
  v1::CreateSessionRequest request;
  request.set_session_id(id);
  *request.mutable_session() = std::move(session);
  return client.CreateSession(request);
}

absl::StatusOr<v1::Session> AppendAndSeal(const Invocation& invocation,
                                          const client::Client& client, const std::string& name,
                                          const std::vector<v1::Reading>& readings) {
  {
    ProgressBar bar(invocation.console, "import");
    client::AppendOptions append;
    append.on_progress = [&](int acknowledged, int total) {
      bar.Show(static_cast<double>(acknowledged) / total,
               absl::StrCat(acknowledged, " of ", Count(total, "reading")));
    };
    TRUEPOSE_RETURN_IF_ERROR(client::AppendReadings(client, name, readings, append).status());
  }
  v1::SealSessionRequest seal;
  seal.set_name(name);
  seal.set_reading_count(static_cast<int>(readings.size()));
  return client.SealSession(seal);
}

// A session that an earlier import finished: the same readings are a success, others a fault.
absl::StatusOr<v1::Session> CheckFinished(const v1::Session& session,
                                          const std::vector<v1::Reading>& readings) {
  if (session.digest() == convert::ReadingsDigest(readings)) return session;
  return OptionFault("--session-id", ShortName(session.name()),
                     "the UUID of a session with these readings, or none");
}

absl::StatusOr<v1::Session> Upload(const Invocation& invocation, const Options& options,
                                   const client::Client& client, const v1::SessionInput& input) {
  const std::string id =
      options.session_id.empty() ? RandomUuid() : ShortName(SessionName(options.session_id));
  const std::vector<v1::Reading> readings(input.readings().begin(), input.readings().end());
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Session created, Create(client, id, input.session()));
  if (created.state() == v1::SEALED) return CheckFinished(created, readings);
  absl::StatusOr<v1::Session> sealed = AppendAndSeal(invocation, client, created.name(), readings);
  if (sealed.ok()) return sealed;
  return WithHint(
      sealed.status(), sealed.status().code(),
      absl::StrCat("Session ", id,
                   " stays open, so no calibration can use it. To go on, repeat the import "
                   "with --session-id ",
                   id, "."));
}

std::string ImportedText(const v1::Session& session) {
  const std::string robot = ShortName(session.robot());
  return absl::StrCat("Session ", ShortName(session.name()), ": ",
                      Count(session.reading_count(), "reading"), " of ", robot,
                      ", sealed\nNext: truepose calibrate --robot ", robot, " --session ",
                      ShortName(session.name()), " --split even-odd\n");
}

absl::Status Import(const Invocation& invocation, const Options& options) {
  return WithServer(invocation, kRobotHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::SessionInput input, Load(invocation, options, client));
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::Session session,
                              Upload(invocation, options, client, input));
    return Reply(invocation, session, [&] { return ImportedText(session); });
  });
}

}  // namespace

void AddSessionImport(const Command& session) {
  const auto options = std::make_shared<Options>();
  session.Add("import", "Read a session file and seal it on the server")
      .Required("FILE", "", &options->file, "Session file (CSV, docs/formats.md)")
      .Required("--robot", "NAME", &options->robot, "The robot that was measured, such as ur10")
      .Option("--euler", "CONVENTION", &options->euler,
              "Read rx_deg,ry_deg,rz_deg by this convention, such as xyz-intrinsic")
      .Option("--name", "TEXT", &options->display_name,
              "What people call it; default: the file's name")
      .Option("--instrument", "NAME", &options->instrument,
              "What measured; calibrations say when its certificate had expired")
      .Option("--placement", "NAME", &options->placement,
              "Where it stands, when it stood there before (placement list)")
      .Option("--operator", "TEXT", &options->operator_name, "Who measured")
      .Option("--temperature", "C", &options->temperature, "Air at the robot")
      .Option("--session-id", "UUID", &options->session_id,
              "Go on with an import that was interrupted")
      .Option("--strict-limits", "", &options->strict_limits,
              "A joint beyond its limit is an error")
      .Footer(
          "Examples:\n  truepose session import series_C.csv --robot ur10\n"
          "  truepose session import arm.csv --robot arm6 --euler xyz-intrinsic --strict-limits\n"
          "  truepose session import monday.csv --robot ur10 --instrument lt-1 --temperature 21.5")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return Import(invocation, *options); });
}

}  // namespace truepose::cli
