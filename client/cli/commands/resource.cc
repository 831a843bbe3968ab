// truepose instrument|tool|fixture|target|placement|pose-set ...; update, delete and undelete also
// of robots and sessions
#include "client/cli/commands/resource.h"

#include <memory>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "client/cli/commands/commands.h"
#include "client/cli/commands/list_options.h"
#include "client/cli/commands/resource_content.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/resource_text.h"
#include "client/cli/written_units.h"
#include "core/base/status_macros.h"
#include "google/protobuf/field_mask.pb.h"
#include "google/protobuf/util/field_mask_util.h"

namespace truepose::cli {
namespace {

using google::protobuf::Message;

// "an instrument"
std::string One(const ResourceKind& kind) {
  const bool vowel = std::string("aeiou").find(kind.word[0]) != std::string::npos;
  return absl::StrCat(vowel ? "an " : "a ", kind.word);
}

struct Options {
  std::string name;
  ContentOptions content;
  std::string etag;
  bool validate_only = false;
};

std::string Hint(const ResourceKind& kind) {
  return absl::StrCat("`truepose ", kind.word, " list` shows what this server has.");
}

void SetText(Message& message, const std::string& field, const std::string& text) {
  const auto* found = message.GetDescriptor()->FindFieldByName(field);
  message.GetReflection()->SetString(&message, found, text);
}

absl::Status RunAndReply(const Invocation& invocation, const ResourceKind& kind,
                         const client::Client& client, StandardCall& call,
                         const std::string& last_line = "") {
  TRUEPOSE_RETURN_IF_ERROR(call.Run(client));
  return Reply(invocation, *call.response,
               [&] { return absl::StrCat(ResourceText(kind, *call.response), last_line); });
}

// "RegisteredTool" -> "registered_tool_id", as the server names the field of the id.
std::string IdField(const Message& request) {
  const auto* descriptor = request.GetDescriptor();
  for (int i = 0; i < descriptor->field_count(); ++i) {
    const std::string& name = descriptor->field(i)->name();
    if (name != "request_id" && name.ends_with("_id")) return name;
  }
  return "";
}

absl::Status Create(const Invocation& invocation, const ResourceKind& kind,
                    const Options& options) {
  const std::string name = ResourceName(kind, options.name);
  const std::vector<std::string> parts = absl::StrSplit(name, '/');
  if (kind.of_robot && parts.size() != 4)
    return OptionFault("NAME", options.name, absl::StrCat("ROBOT/ID such as ", kind.example_id));
  return WithServer(invocation, Hint(kind), [&](const client::Client& client) -> absl::Status {
    StandardCall call(kind, "Create");
    const std::string id_field = IdField(*call.request);
    if (kind.of_robot) call.Set("parent", RobotOf(name));
    call.Set(id_field, parts.back());
    call.Set("validate_only", options.validate_only);
    formats::GivenFields given;
    TRUEPOSE_RETURN_IF_ERROR(ReadContent(client, kind, name, options.content, /*needed=*/false,
                                         call.content(kind), given));
    return InWrittenUnits(
        RenameFields(RunAndReply(invocation, kind, client, call), {{id_field, "NAME"}}), given);
  });
}

absl::Status Show(const Invocation& invocation, const ResourceKind& kind, const std::string& name) {
  return WithServer(invocation, Hint(kind), [&](const client::Client& client) {
    StandardCall call(kind, "Get");
    call.Set("name", ResourceName(kind, name));
    return RunAndReply(invocation, kind, client, call);
  });
}

absl::Status Update(const Invocation& invocation, const ResourceKind& kind,
                    const Options& options) {
  const std::string name = ResourceName(kind, options.name);
  return WithServer(invocation, Hint(kind), [&](const client::Client& client) -> absl::Status {
    StandardCall call(kind, "Update");
    Message& content = call.content(kind);
    formats::GivenFields given;
    TRUEPOSE_RETURN_IF_ERROR(
        ReadContent(client, kind, name, options.content, /*needed=*/true, content, given));
    SetText(content, "name", name);
    if (!options.etag.empty()) SetText(content, "etag", options.etag);
    call.Set("validate_only", options.validate_only);
    const auto* mask = call.request->GetDescriptor()->FindFieldByName("update_mask");
    auto* paths = static_cast<google::protobuf::FieldMask*>(
        call.request->GetReflection()->MutableMessage(call.request.get(), mask));
    for (const std::string& path : given.paths) paths->add_paths(path);
    return InWrittenUnits(RunAndReply(invocation, kind, client, call), given);
  });
}

absl::Status SetDeleted(const Invocation& invocation, const ResourceKind& kind,
                        const Options& options, bool deleted) {
  return WithServer(invocation, Hint(kind), [&](const client::Client& client) {
    StandardCall call(kind, deleted ? "Delete" : "Undelete");
    const std::string name = ResourceName(kind, options.name);
    call.Set("name", name);
    call.Set("etag", options.etag);
    call.Set("validate_only", options.validate_only);
    const std::string next = absl::StrCat("`truepose ", kind.word, " undelete ",
                                          ShortResourceName(kind, name), "` brings it back.\n");
    const std::string last = options.validate_only ? "Dry run: nothing was changed.\n"
                             : deleted             ? next
                                                   : "";
    return RunAndReply(invocation, kind, client, call, last);
  });
}

// All pages in one response.
absl::Status ListAll(const client::Client& client, StandardCall& call, Message& all) {
  const auto* token = call.response->GetDescriptor()->FindFieldByName("next_page_token");
  for (;;) {
    TRUEPOSE_RETURN_IF_ERROR(call.Run(client));
    all.MergeFrom(*call.response);
    const std::string next = call.response->GetReflection()->GetString(*call.response, token);
    if (next.empty()) break;
    call.Set("page_token", next);
  }
  all.GetReflection()->ClearField(&all, token);
  return absl::OkStatus();
}

absl::Status List(const Invocation& invocation, const ResourceKind& kind,
                  const ListOptions& options) {
  return WithServer(invocation, kRobotHint, [&](const client::Client& client) -> absl::Status {
    StandardCall call(kind, "List");
    call.Set("parent", RobotName(options.robot));
    call.Set("filter", options.filter);
    call.Set("show_deleted", options.show_deleted);
    const std::unique_ptr<Message> all(call.response->New());
    TRUEPOSE_RETURN_IF_ERROR(AsListed(ListAll(client, call, *all)));
    return Reply(invocation, *all, [&] { return ResourcesTable(kind, *all); });
  });
}

std::string Example(const ResourceKind& kind, const std::string& verb, const std::string& rest) {
  return absl::StrCat("  truepose ", kind.word, " ", verb, " ", kind.example_id, rest, "\n");
}

void AddDryRun(const Command& command, Options* options) {
  command.Option("--dry-run", "", &options->validate_only,
                 "Only check it; nothing is changed (validate_only)");
}

void AddEtag(const Command& command, Options* options) {
  command.Option("--etag", "ETAG", &options->etag,
                 "Only if it is still in this state (of --json); default: whatever state");
}

void AddCreate(const Command& group, const ResourceKind& kind) {
  const auto options = std::make_shared<Options>();
  const Command command = group.Add("create", "Add " + One(kind));
  command.Required("NAME", "", &options->name,
                   kind.of_robot ? "ROBOT/ID" : "Lower-case letters, digits and -");
  AddContentOptions(command, kind, &options->content);
  AddDryRun(command, options.get());
  command
      .Footer(absl::StrCat(KeysFooter(kind), "Examples:\n",
                           Example(kind, "create", " --set " + kind.example_set),
                           Example(kind, "create", " --file " + kind.word + ".yaml")))
      .Run(Command::Reach::kRemote, [&kind, options](const Invocation& invocation) {
        return Create(invocation, kind, *options);
      });
}

void AddShow(const Command& group, const ResourceKind& kind) {
  const auto name = std::make_shared<std::string>();
  group.Add("show", absl::StrCat("Show one ", kind.word))
      .Required("NAME", "", name.get(), "Such as " + kind.example_id)
      .Footer(
          absl::StrCat("Examples:\n", Example(kind, "show", ""), Example(kind, "show", " --json")))
      .Run(Command::Reach::kRemote,
           [&kind, name](const Invocation& invocation) { return Show(invocation, kind, *name); });
}

void AddList(const Command& group, const ResourceKind& kind) {
  const auto options = std::make_shared<ListOptions>();
  const Command command = group.Add("list", absl::StrCat("List the ", kind.word, "s"));
  AddListOptions(command, {kind.of_robot, true, "display_name = \"*hall 3*\""}, options.get());
  command
      .Footer(absl::StrCat("Examples:\n  truepose ", kind.word, " list\n  truepose ", kind.word,
                           " list --show-deleted --json"))
      .Run(Command::Reach::kRemote, [&kind, options](const Invocation& invocation) {
        return List(invocation, kind, *options);
      });
}

void AddUpdate(const Command& group, const ResourceKind& kind) {
  const auto options = std::make_shared<Options>();
  const Command command = group.Add("update", "Change fields of " + One(kind));
  command.Required("NAME", "", &options->name, "Such as " + kind.example_id);
  AddContentOptions(command, kind, &options->content);
  AddEtag(command, options.get());
  AddDryRun(command, options.get());
  command
      .Footer(absl::StrCat(KeysFooter(kind), "KEY= empties a field.\n\nExamples:\n",
                           Example(kind, "update", " --set " + kind.example_set),
                           Example(kind, "update", " --set display_name=")))
      .Run(Command::Reach::kRemote, [&kind, options](const Invocation& invocation) {
        return Update(invocation, kind, *options);
      });
}

void AddDeletion(const Command& group, const ResourceKind& kind, bool deleted) {
  const auto options = std::make_shared<Options>();
  const std::string verb = deleted ? "delete" : "undelete";
  const Command command = group.Add(verb, (deleted ? "Hide " : "Bring back ") + One(kind));
  command.Required("NAME", "", &options->name, "Such as " + kind.example_id);
  if (deleted) AddEtag(command, options.get());
  AddDryRun(command, options.get());
  command.Footer(absl::StrCat("Example:\n", Example(kind, verb, "")))
      .Run(Command::Reach::kRemote, [&kind, options, deleted](const Invocation& invocation) {
        return SetDeleted(invocation, kind, *options, deleted);
      });
}

}  // namespace

void AddResourceChanges(const Command& group, const ResourceKind& kind) {
  AddUpdate(group, kind);
  AddDeletion(group, kind, true);
  AddDeletion(group, kind, false);
}

void AddResource(const Command& root, const ResourceKind& kind) {
  const Command group = root.Add(kind.word, kind.summary);
  group.Footer(absl::StrCat("Example:\n  truepose ", kind.word, " list"));
  AddCreate(group, kind);
  AddShow(group, kind);
  AddList(group, kind);
  AddResourceChanges(group, kind);
}

void AddPlant(const Command& root) {
  for (const ResourceKind& kind : PlantKinds()) AddResource(root, kind);
}

}  // namespace truepose::cli
