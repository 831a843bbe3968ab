// truepose model: the parameters of a robot's model, without any reading.
#include <map>
#include <memory>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "client/cli/commands/commands.h"
#include "client/cli/inputs.h"
#include "client/cli/outcome.h"
#include "client/cli/reply.h"
#include "client/cli/table.h"
#include "convert/run.h"
#include "core/base/status_macros.h"
#include "core/conversion/describe.h"

namespace truepose::cli {
namespace {

constexpr char kIndent[] = "  ";

struct Options {
  std::string robot;
  std::string model = "modified_incremental";
  formats::UrdfEnds ends;
};

struct LinkNames {
  std::vector<std::string> kept, dropped;
};

// By the text of the link.
using Links = std::map<std::string, LinkNames>;

std::string LinkText(const v1::ModelParameter& parameter, const v1::Nominal& nominal) {
  if (parameter.group() == v1::BASE) return "base";
  if (parameter.group() == v1::TOOL) return "tool";
  const int link = LinkOf(parameter.name()).value_or(0);
  if (link < 1 || link > nominal.joints_size()) return absl::StrCat(link);
  return absl::StrCat(link, " (joint ", nominal.joints(link - 1).name(), ")");
}

std::string LinksTable(const v1::ModelDescription& model, const v1::Nominal& nominal) {
  std::vector<std::string> order;
  Links links;
  for (const v1::ModelParameter& parameter : model.parameters()) {
    const std::string link = LinkText(parameter, nominal);
    if (!links.contains(link)) order.push_back(link);
    (parameter.kept() ? links[link].kept : links[link].dropped).push_back(parameter.name());
  }
  Table table({{"link", Align::kLeft}, {"kept", Align::kLeft}, {"dropped", Align::kLeft}});
  for (const std::string& link : order)
    table.Add(
        {link, absl::StrJoin(links[link].kept, " "), absl::StrJoin(links[link].dropped, " ")});
  return table.Text(kIndent);
}

int KeptInternal(const v1::ModelDescription& model) {
  int kept = 0;
  for (const v1::ModelParameter& parameter : model.parameters())
    kept += parameter.kept() && parameter.group() == v1::INTERNAL;
  return kept;
}

std::string CountsTable(const v1::ModelDescription& model) {
  Table table({{"parameters", Align::kLeft}, {"by formula"}, {"identifiable"}});
  table.Add({"complete, 4R + 2P + 6", absl::StrCat(model.counts().complete()),
             absl::StrCat(model.counts().generic_rank())});
  table.Add({"internal, 4R + 2P - 6", absl::StrCat(model.counts().internal()),
             absl::StrCat(KeptInternal(model))});
  return table.Text(kIndent);
}

std::string Redundancies(const v1::ModelDescription& model) {
  if (model.redundancies().empty()) return "";
  std::string text = "\nRedundant at any poses\n";
  for (const v1::Redundancy& redundancy : model.redundancies())
    absl::StrAppend(&text, kIndent, redundancy.reason(), "\n");
  return text;
}

std::string Text(const v1::ModelDescription& model, const formats::RobotFile& file) {
  return absl::StrCat(
      "Model ", model.model(), " of ", file.robot_id, ": ",
      Count(model.parameters_size(), "candidate"), ", ", model.counts().generic_rank(),
      " identifiable from full poses of one tool at one place\nConvention ", model.convention(),
      "\n\n", LinksTable(model, file.nominal), "\n", CountsTable(model), Redundancies(model));
}

absl::Status Describe(const Invocation& invocation, const Options& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const formats::RobotFile file, LoadRobot(options.robot, options.ends));
  const auto model = convert::RunModelDescription(file.nominal, options.model);
  if (!model.ok()) return RenameFields(model.status(), {{"options.model", "--model"}});
  return Reply(invocation, *model, [&] { return Text(*model, file); });
}

}  // namespace

void AddModel(const Command& root) {
  const auto options = std::make_shared<Options>();
  root.Add("model", "Show the parameters of a robot's model, and which are redundant")
      .Required("FILE", "", &options->robot, "Robot file")
      .Option("--model", "KIND", &options->model,
              "modified_incremental, incremental, zhuang_roth or extended_dh")
      .Option("--urdf-base", "LINK", &options->ends.base, kUrdfBaseHelp)
      .Option("--urdf-tip", "LINK", &options->ends.tip, kUrdfTipHelp)
      .Footer(
          "Without readings: what full poses of the tool could identify at best. Lengths are\n"
          "errors in mm, angles in deg; docs/models.md says what each name means.\n\nExamples:\n"
          "  truepose model ur10.yaml\n"
          "  truepose model ur10.yaml --model extended_dh\n"
          "  truepose model cell.urdf --urdf-base base_link --urdf-tip tool0\n"
          "  truepose model ur10.yaml --json")
      .Run(Command::Reach::kLocal,
           [options](const Invocation& invocation) { return Describe(invocation, *options); });
}

}  // namespace truepose::cli
