// truepose admin bootstrap
#include <fstream>
#include <memory>
#include <string>

#include "client/cli/commands/commands.h"
#include "client/cli/commands/new_token.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

struct BootstrapOptions {
  std::string file, principal, output;
};

absl::StatusOr<std::string> FirstLine(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (std::getline(file, line)) return line;
  return FaultStatus(path, "nothing that can be read",
                     "the file <database>.bootstrap that the server wrote when it started");
}

absl::Status Bootstrap(const Invocation& invocation, const BootstrapOptions& options) {
  v1::BootstrapRequest request;
  TRUEPOSE_ASSIGN_OR_RETURN(*request.mutable_secret(), FirstLine(options.file));
  request.set_principal(options.principal);
  return PrintNewToken(invocation, options.output,
                       {{"principal", "--principal"}, {"secret", options.file}},
                       [&](const client::Client& client) { return client.Bootstrap(request); });
}

}  // namespace

void AddAdmin(const Command& root) {
  const Command admin = root.Add("admin", "The first admin of a server");
  const auto options = std::make_shared<BootstrapOptions>();
  admin.Add("bootstrap", "Become the first admin, with the secret beside the database")
      .Required("FILE", "", &options->file, "<database>.bootstrap, which the server wrote")
      .Required("--principal", "NAME", &options->principal, "Who the admin is, such as anna")
      .Option("--output", "FILE", &options->output, kTokenOutputHelp)
      .Footer(
          "Example:\n"
          "  truepose admin bootstrap truepose.db.bootstrap --principal anna --output anna.token")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return Bootstrap(invocation, *options); });
}

}  // namespace truepose::cli
