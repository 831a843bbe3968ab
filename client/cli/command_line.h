// The command line as our commands see it; the parser behind it is command_line.cc's business only.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "absl/status/status.h"
#include "client/cli/console.h"

namespace CLI {
class App;
}

namespace truepose::cli {

// What every command is told beside its own options.
struct Invocation {
  const Console& console;
  bool json = false;
  std::string server;                  // an address
  std::vector<std::string> passed_on;  // of a command that hands its arguments to another program
  std::string token_file = {};         // --token-file; "" = where client/token_file.h looks
};

using Action = std::function<absl::Status(const Invocation&)>;

// Filled when the command line is parsed; it has to live until then. A list option may be given
// several times or with several values.
using Target = std::variant<bool*, int*, unsigned long long*, double*, std::string*,
                            std::vector<std::string>*>;

class CommandLine;

// One command or group of commands while it is being described. A light handle: copy it.
class Command {
 public:
  Command Add(const std::string& name, const std::string& summary) const;

  // `names` as "--output" or "FILE" (a positional); `value` is the placeholder in the help, "" for
  // flags and positionals.
  const Command& Option(const std::string& names, const std::string& value, Target target,
                        const std::string& help) const;
  const Command& Required(const std::string& names, const std::string& value, Target target,
                          const std::string& help) const;
  // Text below the options.
  const Command& Footer(const std::string& text) const;

  // What the command does. It takes --json from here on; a remote one takes --server and
  // --token-file as well.
  enum class Reach { kLocal, kRemote };
  void Run(Reach reach, Action action) const;
  // Hands everything after its name to `action` as Invocation::passed_on, --help included.
  void PassOn(Action action) const;

 private:
  friend class CommandLine;
  Command(CLI::App* app, CommandLine* line) : app_(app), line_(line) {}
  CLI::App* app_;
  CommandLine* line_;
};

class CommandLine {
 public:
  CommandLine(const std::string& program, const std::string& summary);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  Command root();

  // Parses and runs. --help prints on console.out.
  // @returns the action's status; a UsageError when the line can't be understood; an option fault
  // for a value that is
  //   not of its type.
  absl::Status Run(const std::vector<std::string>& arguments, const Console& console);

 private:
  friend class Command;
  absl::Status Parse(const std::vector<std::string>& arguments, const Console& console,
                     bool* helped);
  absl::Status RunSelected(const Console& console);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace truepose::cli
