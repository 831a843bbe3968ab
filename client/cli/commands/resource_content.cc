#include "client/cli/commands/resource_content.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "client/cli/commands/table.h"
#include "client/cli/inputs.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "formats/message_text.h"
#include "formats/targets_file.h"
#include "truepose/v1/plant.pb.h"

namespace truepose::cli {
namespace {

using google::protobuf::Message;

std::string FirstPart(const std::string& path) { return path.substr(0, path.find('.')); }

bool IsOfServer(const ResourceKind& kind, const std::string& path) {
  const std::vector<std::string> fields = OutputOnly(kind);
  return std::find(fields.begin(), fields.end(), FirstPart(path)) != fields.end();
}

// Every part without "=" is a fault, and so is one that only the server sets.
absl::StatusOr<std::vector<std::pair<std::string, std::string>>> SplitSets(
    const ResourceKind& kind, const std::vector<std::string>& sets) {
  std::vector<std::pair<std::string, std::string>> fields;
  FaultList faults;
  for (const std::string& set : sets) {
    const size_t equals = set.find('=');
    if (equals == std::string::npos) {
      faults.Add("--set", absl::StrCat("'", set, "'"), "KEY=VALUE; --help has the keys");
      continue;
    }
    if (IsOfServer(kind, set.substr(0, equals))) {
      faults.Add("--set", absl::StrCat("'", set, "', which only the server sets"),
                 "a key that --help lists");
    }
    fields.emplace_back(set.substr(0, equals), set.substr(equals + 1));
  }
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  return fields;
}

// The file's rows are joints or poses of the robot; a pose set has joints.
absl::Status ReadPoses(const client::Client& client, const std::string& robot,
                       const std::string& path, v1::PoseSet& set) {
  v1::GetRobotRequest request;
  request.set_name(robot);
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot found, client.GetRobot(request));
  auto targets = formats::ReadTargetsFile(path, found.nominal_revision().nominal());
  if (!targets.ok()) return AsInputFault(targets.status());
  FaultList faults;
  for (const v1::CompensationTarget& target : *targets) {
    if (target.joints().empty()) {
      faults.Add(absl::StrCat(path, ": row ", target.row()), "no joints", "q1_deg, q2_deg, ...");
    }
    *set.add_poses()->mutable_joints() = target.joints();
  }
  return faults.ToStatus();
}

}  // namespace

void AddContentOptions(const Command& command, const ResourceKind& kind, ContentOptions* options) {
  command.Option("--file", "FILE", &options->file, "YAML or JSON with these keys (docs/cli.md)")
      .Option("--set", "KEY=VALUE", &options->set, "Fields one by one, over those of the file");
  if (kind.word == "fixture") {
    command.Option("--features", "FILE", &options->features, "The features, as a fixture file");
  }
  if (kind.word == "robot") {
    command.Option("--table-spec", "FILE", &options->table_spec,
                   "Domain and tolerances of the table that follows each activation (YAML or "
                   "JSON); --set table_spec= ends that");
  }
  if (kind.word == "pose-set") {
    command.Option("--poses", "FILE", &options->poses, "The poses, as CSV with joint columns");
  }
}

std::string KeysFooter(const ResourceKind& kind) {
  return absl::StrCat(
      "Keys (a length may be in _m as well, an angle in _rad):\n  ",
      absl::StrJoin(formats::SettableKeys(*kind.content->GetDescriptor(), OutputOnly(kind)),
                    "\n  "),
      "\n\n");
}

absl::Status ReadContent(const client::Client& client, const ResourceKind& kind,
                         const std::string& name, const ContentOptions& options, bool needed,
                         Message& content, formats::GivenFields& given) {
  if (!options.file.empty()) {
    TRUEPOSE_RETURN_IF_ERROR(AsInputFault(formats::ReadMessageFile(options.file, content, given)));
    std::erase_if(given.paths, [&](const std::string& path) { return IsOfServer(kind, path); });
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const auto fields, SplitSets(kind, options.set));
  TRUEPOSE_RETURN_IF_ERROR(formats::SetMessageFields(fields, "--set", content, given));
  if (!options.features.empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(*static_cast<v1::RegisteredFixture&>(content).mutable_fixture(),
                              LoadFixture(options.features));
    given.paths.push_back("fixture");
  }
  if (!options.poses.empty()) {
    TRUEPOSE_RETURN_IF_ERROR(
        ReadPoses(client, RobotOf(name), options.poses, static_cast<v1::PoseSet&>(content)));
    given.paths.push_back("poses");
  }
  if (!options.table_spec.empty()) {
    formats::GivenFields fields_of_spec;
    v1::CompensationTableSpec& spec = *static_cast<v1::Robot&>(content).mutable_table_spec();
    TRUEPOSE_RETURN_IF_ERROR(
        AsInputFault(formats::ReadMessageFile(options.table_spec, spec, fields_of_spec)));
    TRUEPOSE_RETURN_IF_ERROR(CheckTableSpec(spec, fields_of_spec, options.table_spec + ": "));
    for (const std::string& field : fields_of_spec.in_si)
      given.in_si.push_back("table_spec." + field);
    given.paths.push_back("table_spec");
  }
  if (given.paths.empty() && needed) return UsageError("nothing to change: give --set or --file");
  return absl::OkStatus();
}

}  // namespace truepose::cli
