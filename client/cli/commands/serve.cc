// truepose serve: becomes trueposed.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/cli/commands/commands.h"

namespace truepose::cli {
namespace {

constexpr char kServer[] = "trueposed";
constexpr char kHelp[] =
    R"(Runs the server until Ctrl-C. All options are those of trueposed, which this command becomes.

Examples:
  truepose serve --dev-open
  truepose serve --database /var/lib/truepose/plant.db --listen 127.0.0.1:7900
  truepose serve --listen unix:/run/truepose.sock

)";

// Beside this program (an installed pair), where a build tree has it, else by PATH.
std::string ServerProgram() {
  std::error_code error;
  const std::filesystem::path folder =
      std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const std::filesystem::path& candidate :
       {folder / kServer, folder / "../../server" / kServer}) {
    if (!error && access(candidate.c_str(), X_OK) == 0)
      return candidate.lexically_normal().string();
  }
  return kServer;
}

// Comes back only when it failed.
absl::Status Exec(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), kServer);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  const std::string program = ServerProgram();
  execvp(program.c_str(), pointers.data());
  return absl::FailedPreconditionError(absl::StrCat("can't start ", program, " (",
                                                    std::strerror(errno),
                                                    "); expected it beside truepose or on PATH"));
}

absl::Status Serve(const Invocation& invocation) {
  const std::vector<std::string>& arguments = invocation.passed_on;
  const auto asks = [&](const char* option) {
    return std::find(arguments.begin(), arguments.end(), option) != arguments.end();
  };
  if (asks("--help") || asks("-h")) invocation.console.out << kHelp << std::flush;
  return Exec(arguments);
}

}  // namespace

void AddServe(const Command& root) {
  root.Add("serve", "Run the server (trueposed)").PassOn(Serve);
}

}  // namespace truepose::cli
