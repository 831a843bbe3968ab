#include "client/cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <map>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/string_view.h"
#include "absl/strings/strip.h"
#include "client/cli/outcome.h"
#include "client/cli/same_file.h"
#include "core/base/status_macros.h"

namespace truepose::cli {

namespace {

std::string ServerByEnvironment() {
  const char* address = std::getenv("TRUEPOSE_SERVER");
  return address == nullptr || *address == '\0' ? "127.0.0.1:7878" : address;
}

}  // namespace

struct CommandLine::Impl {
  explicit Impl(const std::string& summary) : app(summary) {}

  CLI::App app;
  std::map<const CLI::App*, Action> actions;
  bool json = false;
  // Read here and not by the parser, which sets the variable anew for every command that has the
  // option, after it has read the command line.
  std::string server = ServerByEnvironment();
  std::string token_file;
};

namespace {

CLI::Option* AddOption(CLI::App* app, const std::string& names, const Target& target,
                       const std::string& help) {
  if (bool* const* flag = std::get_if<bool*>(&target)) return app->add_flag(names, **flag, help);
  return std::visit([&](auto* value) { return app->add_option(names, *value, help); }, target);
}

CLI::Option* Describe(CLI::App* app, const std::string& names, const std::string& value,
                      const Target& target, const std::string& help) {
  CLI::Option* option = AddOption(app, names, target, help);
  // Without a value text the parser would print the C++ type.
  if (!std::holds_alternative<bool*>(target)) option->type_name(value);
  // A number that stands is worth showing; an empty text is not.
  if (std::holds_alternative<double*>(target) || std::holds_alternative<int*>(target) ||
      std::holds_alternative<unsigned long long*>(target)) {
    option->capture_default_str();
  }
  return option;
}

const CLI::App* Deepest(const CLI::App* app) {
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  return app;
}

// "truepose session import"
std::string FullName(const CLI::App* app) {
  if (app->get_parent() == nullptr) return app->get_name();
  return absl::StrCat(FullName(app->get_parent()), " ", app->get_name());
}

// The parser says "Could not convert: --poses = abc" and has no other way to ask for the parts.
absl::Status ConversionFault(absl::string_view what) {
  absl::ConsumePrefix(&what, "Could not convert: ");
  const std::vector<std::string> parts = absl::StrSplit(what, absl::MaxSplits(" = ", 1));
  return OptionFault(parts.front(), parts.back(), "a number; --help shows which");
}

constexpr absl::string_view kOutputs[] = {"--output", "--csv", "--svg", "--truth"};

bool IsOutput(const CLI::Option& option) {
  return std::find(std::begin(kOutputs), std::end(kOutputs), option.get_name()) !=
         std::end(kOutputs);
}

// Nothing that a command reads is what it writes over, and no two of its outputs are one file.
absl::Status CheckOutput(const CLI::Option& output, const CLI::Option& other) {
  for (const std::string& path : output.results()) {
    for (const std::string& named : other.results()) {
      TRUEPOSE_RETURN_IF_ERROR(CheckOtherFile(named, path, output.get_name()));
      if (IsOutput(other) && named == path)
        return OptionFault(output.get_name(), path,
                           absl::StrCat("another file than ", other.get_name()));
    }
  }
  return absl::OkStatus();
}

absl::Status CheckOutputs(const CLI::App& command) {
  for (const CLI::Option* output : command.get_options()) {
    if (!IsOutput(*output)) continue;
    for (const CLI::Option* other : command.get_options())
      if (other != output) TRUEPOSE_RETURN_IF_ERROR(CheckOutput(*output, *other));
  }
  return absl::OkStatus();
}

}  // namespace

Command Command::Add(const std::string& name, const std::string& summary) const {
  app_->require_subcommand(0, 1);
  CLI::App* const added = app_->add_subcommand(name, summary);
  // The parser hands a command's footer down, but its text is about that command alone.
  added->footer("");
  return Command(added, line_);
}

const Command& Command::Option(const std::string& names, const std::string& value, Target target,
                               const std::string& help) const {
  Describe(app_, names, value, target, help);
  return *this;
}

const Command& Command::Required(const std::string& names, const std::string& value, Target target,
                                 const std::string& help) const {
  Describe(app_, names, value, target, help)->required();
  return *this;
}

const Command& Command::Footer(const std::string& text) const {
  app_->footer(text);
  return *this;
}

void Command::Run(Reach reach, Action action) const {
  CommandLine::Impl& impl = *line_->impl_;
  app_->add_flag("--json", impl.json, "Print one JSON object");
  if (reach == Reach::kRemote) {
    app_->add_option(
            "--server", impl.server,
            "Where trueposed listens: host:port or unix:/path; TRUEPOSE_SERVER says it, too")
        ->type_name("ADDRESS")
        ->capture_default_str();
    app_->add_option("--token-file", impl.token_file,
                     "File with your token; default: TRUEPOSE_TOKEN, ~/.config/truepose/token")
        ->type_name("FILE");
  }
  impl.actions[app_] = std::move(action);
}

void Command::PassOn(Action action) const {
  app_->prefix_command();
  app_->set_help_flag();
  line_->impl_->actions[app_] = std::move(action);
}

CommandLine::CommandLine(const std::string& program, const std::string& summary)
    : impl_(std::make_unique<Impl>(summary)) {
  impl_->app.name(program);
  impl_->app.get_formatter()->column_width(34);
}

CommandLine::~CommandLine() = default;

Command CommandLine::root() { return Command(&impl_->app, this); }

absl::Status CommandLine::Parse(const std::vector<std::string>& arguments, const Console& console,
                                bool* helped) {
  // The parser takes its arguments from the back.
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  try {
    impl_->app.parse(reversed);
  } catch (const CLI::CallForHelp&) {
    console.out << impl_->app.help();
    *helped = true;
  } catch (const CLI::ConversionError& error) {
    return ConversionFault(error.what());
  } catch (const CLI::ParseError& error) {
    return UsageError(
        absl::StrCat(error.what(), "\nTry `", FullName(Deepest(&impl_->app)), " --help`."));
  }
  return absl::OkStatus();
}

absl::Status CommandLine::RunSelected(const Console& console) {
  const CLI::App* selected = Deepest(&impl_->app);
  const auto action = impl_->actions.find(selected);
  if (action == impl_->actions.end()) {
    return UsageError(absl::StrCat("a command is missing after `", FullName(selected), "`\nTry `",
                                   FullName(selected), " --help`."));
  }
  TRUEPOSE_RETURN_IF_ERROR(CheckOutputs(*selected));
  return action->second(
      {console, impl_->json, impl_->server, selected->remaining(), impl_->token_file});
}

absl::Status CommandLine::Run(const std::vector<std::string>& arguments, const Console& console) {
  bool helped = false;
  if (absl::Status status = Parse(arguments, console, &helped); !status.ok() || helped)
    return status;
  return RunSelected(console);
}

}  // namespace truepose::cli
