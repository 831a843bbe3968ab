#include "client/cli/commands/list_options.h"

#include "absl/strings/str_cat.h"
#include "client/cli/outcome.h"

namespace truepose::cli {

void AddListOptions(const Command& command, const ListHas& has, ListOptions* options) {
  if (has.robot) command.Option("--robot", "NAME", &options->robot, "Only of this robot");
  command.Option("--filter", "FILTER", &options->filter,
                 absl::StrCat("Terms joined by AND, such as: ", has.example));
  if (has.deleted) {
    command.Option("--show-deleted", "", &options->show_deleted, "Deleted ones as well");
  }
}

absl::Status AsListed(const absl::Status& status) {
  return RenameFields(status, {{"filter", "--filter"}});
}

}  // namespace truepose::cli
