// truepose watch: what changes in a plant, line by line.
#include "client/watch.h"

#include <algorithm>
#include <memory>
#include <ostream>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/strip.h"
#include "client/cli/commands/calibrate.h"
#include "client/cli/commands/commands.h"
#include "client/cli/interrupt.h"
#include "client/cli/json.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/remote.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

struct Options {
  std::string robot, resource, from = "0";
  std::vector<std::string> kinds;
  bool progress = false;
  int count = 0;
};

constexpr absl::string_view kKindPrefix = "KIND_";

// KIND_POSE_SET -> "pose-set"
std::string KindWord(v1::ResourceKind kind) {
  const std::string& name = v1::ResourceKind_Name(kind);
  return absl::StrReplaceAll(absl::AsciiStrToLower(absl::StripPrefix(name, kKindPrefix)),
                             {{"_", "-"}});
}

absl::StatusOr<v1::WatchRequest> RequestOf(const Options& options) {
  v1::WatchRequest request;
  FaultList faults;
  request.set_robot(RobotName(options.robot));
  request.set_resource(options.resource);
  request.set_progress(options.progress);
  // "EPOCH:REVISION" or "REVISION"
  const size_t colon = options.from.find(':');
  const bool has_epoch = colon != std::string::npos;
  int64_t from = 0;
  if (!absl::SimpleAtoi(options.from.substr(has_epoch ? colon + 1 : 0), &from) || from < 0)
    faults.Add("--from", absl::StrCat("'", options.from, "'"), "a revision: 0 or more");
  request.set_after_revision(from);
  if (has_epoch) request.set_epoch(options.from.substr(0, colon));
  for (const std::string& word : options.kinds) {
    v1::ResourceKind kind = v1::RESOURCE_KIND_UNSPECIFIED;
    const std::string name =
        absl::StrCat(kKindPrefix, absl::AsciiStrToUpper(absl::StrReplaceAll(word, {{"-", "_"}})));
    if (!v1::ResourceKind_Parse(name, &kind))
      faults.Add("--kind", absl::StrCat("'", word, "'"), "a kind; --help has them");
    request.add_kinds(kind);
  }
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  return request;
}

std::string Lower(const std::string& name) {
  return absl::AsciiStrToLower(absl::StrReplaceAll(name, {{"_", " "}}));
}

// The resource's state in a word, where it has one.
std::string StateOf(const v1::WatchEvent& event) {
  switch (event.resource_case()) {
    case v1::WatchEvent::kRobot:
      if (event.robot().active_calibration().empty()) return "no active calibration";
      return absl::StrCat("active ", ShortName(event.robot().active_calibration()));
    case v1::WatchEvent::kSession:
      return Lower(v1::SessionState_Name(event.session().state()));
    case v1::WatchEvent::kJob:
      return Lower(v1::JobState_Name(event.job().state()));
    case v1::WatchEvent::kCalibration:
      return Lower(v1::ReleaseState_Name(event.calibration().state()));
    case v1::WatchEvent::kRecalibrationRequest:
      return Lower(v1::RecalibrationState_Name(event.recalibration_request().state()));
    default:
      return "";
  }
}

std::string LineOf(const v1::WatchEvent& event) {
  const std::string state = event.deleted() ? "deleted" : StateOf(event);
  return absl::StrFormat("%8d  %-22s %s%s%s\n", event.revision(), KindWord(event.kind()),
                         ShortName(event.name()), state.empty() ? "" : "  ", state);
}

std::string LinesOf(const v1::WatchResponse& response) {
  std::string text;
  for (const v1::WatchEvent& event : response.events()) text += LineOf(event);
  for (const v1::WatchedProgress& progress : response.progress()) {
    absl::StrAppendFormat(&text, "%8s  %-22s %s  %.0f %%, %s\n", "", "progress",
                          ShortName(progress.job()), 100.0 * progress.progress().fraction(),
                          StageText(progress.progress()));
  }
  return text;
}

// A revision without the epoch of its store means the store that is there now.
absl::Status FindEpoch(const client::Client& client, v1::WatchRequest& request) {
  if (request.after_revision() == 0 || !request.epoch().empty()) return absl::OkStatus();
  v1::WatchRequest question;
  question.add_kinds(v1::KIND_TARGET);
  return client.Watch(question, [&](const v1::WatchResponse& response) {
    request.set_epoch(response.epoch());
    return false;
  });
}

// Prints what comes and knows how far it is.
class Printer {
 public:
  Printer(const Invocation& invocation, int count) : invocation_(invocation), left_(count) {}

  // false: no more is wanted.
  bool Take(const v1::WatchResponse& response) {
    is_away_ = false;
    if (response.revision() > 0) place_ = absl::StrCat(response.epoch(), ":", response.revision());
    if (invocation_.json) {
      const auto json = ToJson(response);
      invocation_.console.out << (json.ok() ? *json : "{}") << "\n" << std::flush;
    } else {
      invocation_.console.out << LinesOf(response) << std::flush;
    }
    if (response.snapshot_complete()) TellComplete();
    if (left_ == 0 || response.snapshot()) return true;
    left_ -= std::min(left_, response.events_size());
    return left_ > 0;
  }

  // Tells of the first of several attempts only.
  void TellAway(const absl::Status& why) {
    if (!is_away_) Warn(invocation_.console, absl::StrCat("connecting again: ", why.message()));
    is_away_ = true;
  }

  // What --from takes to go on; "" before the snapshot is complete.
  const std::string& place() const { return place_; }

 private:
  void TellComplete() const {
    invocation_.console.err << "That is all there is now; changes follow. Ctrl-C ends.\n";
  }

  const Invocation& invocation_;
  int left_;  // 0 = without end
  std::string place_;
  bool is_away_ = false;
};

absl::Status Watch(const Invocation& invocation, const Options& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::WatchRequest request, RequestOf(options));
  return WithServer(invocation, kRobotHint, [&](const client::Client& client) -> absl::Status {
    const InterruptScope interrupt;
    TRUEPOSE_RETURN_IF_ERROR(FindEpoch(client, request));
    Printer printer(invocation, options.count);
    client::FollowOptions follow;
    follow.is_cancelled = [&] { return interrupt.interrupted(); };
    follow.on_reconnect = [&](const absl::Status& why) { printer.TellAway(why); };
    const absl::Status status = client::FollowWatch(
        client, request, [&](const auto& response) { return printer.Take(response); }, follow);
    if (!printer.place().empty() && (status.ok() || absl::IsCancelled(status))) {
      invocation.console.err << "To go on here: truepose watch --from " << printer.place() << "\n";
    }
    if (absl::IsCancelled(status)) return absl::OkStatus();
    return WithHint(RenameFields(status, {{"after_revision", "--from"}}),
                    absl::StatusCode::kOutOfRange,
                    "Without --from it begins with what there is now.");
  });
}

}  // namespace

void AddWatch(const Command& root) {
  const auto options = std::make_shared<Options>();
  root.Add("watch", "See what changes: jobs, calibrations, requests, everything")
      .Option("--robot", "NAME", &options->robot, "Only of this robot")
      .Option("--kind", "KIND", &options->kinds, "Only of these kinds (below)")
      .Option("--resource", "NAME", &options->resource,
              "Only this one, by its whole name: jobs/UUID")
      .Option("--from", "[EPOCH:]REVISION", &options->from,
              "Changes after this revision; default: first what there is now")
      .Option("--progress", "", &options->progress, "Also how far running jobs are")
      .Option("--count", "N", &options->count, "End after N changes; default: 0, never")
      .Footer(
          "Goes on by itself when the server was away or started again. With --json one object a\n"
          "message, those that only tell the revision included.\n\n"
          "Kinds: robot, session, job, calibration, recalibration-request, drift-check,\n"
          "robot-event, agent-report, instrument, tool, fixture, target, placement, pose-set,\n"
          "recalibration-policy\n\n"
          "Examples:\n  truepose watch\n  truepose watch --robot ur10 --kind job calibration\n"
          "  truepose watch --from 1204 --json")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return Watch(invocation, *options); });
}

}  // namespace truepose::cli
