// truepose version
#include "client/cli/commands/commands.h"
#include "client/cli/json.h"

namespace truepose::cli {

void AddVersion(const Command& root) {
  root.Add("version", "Print the version")
      .Footer("Example:\n  truepose version")
      .Run(Command::Reach::kLocal, [](const Invocation& invocation) {
        const std::string version = TRUEPOSE_VERSION;
        invocation.console.out << (invocation.json ? "{\"version\":" + JsonString(version) + "}"
                                                   : "truepose " + version)
                               << "\n";
        return absl::OkStatus();
      });
}

}  // namespace truepose::cli
