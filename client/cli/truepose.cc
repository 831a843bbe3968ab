#include "client/cli/truepose.h"

#include <algorithm>

#include "client/cli/command_line.h"
#include "client/cli/commands/commands.h"
#include "client/cli/outcome.h"

namespace truepose::cli {
namespace {

constexpr char kFooter[] =
    R"(Every command has --help with examples. A first round with a robot:
  truepose serve --dev-open &
  truepose robot add ur10.yaml
  truepose session import series_C.csv --robot ur10
  truepose calibrate --robot ur10 --session UUID --split even-odd
  truepose compensate targets.csv --calibration ur10#1 --output corrected.csv
The same without a server:
  truepose calibrate --local --robot ur10.yaml --session series_C.csv --split even-odd

Results go to standard output, everything else to standard error. With --json the output is one
object; of a failure it is {"error":{"code","message","faults":[{"field","found","expected"}]}}.

Exit codes:
  0  done
  1  the run or job failed or was cancelled
  2  the command line was not understood
  3  the input has faults: a file, the value of an option, joint limits with --strict-limits
  4  the server is unreachable, or the address to serve at is in use
  5  the database can't be used
  6  not found: no resource has that name
  7  not allowed: no token, one that holds no longer, or one that may not)";

bool AsksForJson(const std::vector<std::string>& arguments) {
  return std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
}

// A result that did not arrive (a full disk, a reader that went away) is no success.
absl::Status Flush(const Console& console) {
  if (console.out.flush()) return absl::OkStatus();
  const absl::Status status = absl::InternalError("standard output can't be written");
  PrintError(console, false, status);
  return status;
}

}  // namespace

int RunTruepose(const std::vector<std::string>& arguments, const Console& console) {
  CommandLine line("truepose", "Truepose: kinematic calibration of robots, and its compensation");
  line.root().Footer(kFooter);
  AddAllCommands(line.root());
  const absl::Status status = line.Run(arguments, console);
  PrintError(console, AsksForJson(arguments), status);
  return ExitCodeOf(status.ok() ? Flush(console) : status);
}

}  // namespace truepose::cli
