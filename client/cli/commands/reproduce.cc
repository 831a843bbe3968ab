// truepose reproduce: the chapter's own examples, run here.
#include "client/cli/reproduce.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/cli/commands/commands.h"
#include "client/cli/interrupt.h"
#include "client/cli/outcome.h"
#include "client/cli/progress.h"
#include "client/cli/reply.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

constexpr int kMostSeeds = 1000;

double Seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

absl::Status RunTable2(const Invocation& invocation, double q_deg, double q_next_deg, double l_mm) {
  constexpr double kRadians = std::numbers::pi / 180;
  for (const auto& [option, value] :
       {std::pair{"--q-deg", q_deg}, {"--q-next-deg", q_next_deg}, {"--l-mm", l_mm}}) {
    if (!std::isfinite(value)) return OptionFault(option, absl::StrCat(value), "a finite number");
  }
  const Table2Arguments arguments = {kRadians * q_deg, kRadians * q_next_deg, 1e-3 * l_mm, 0};
  const Table2Result table = Table2(arguments);
  return Reply(invocation, Table2Json(table), [&] { return Table2Text(arguments, table); });
}

absl::Status RunTable3(const Invocation& invocation) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<Table3Column> columns, Table3());
  return Reply(invocation, Table3Json(columns), [&] { return Table3Text(columns); });
}

absl::StatusOr<Section11Result> WithProgress(const Invocation& invocation, int seeds) {
  Section11Options options;
  options.clock = Seconds;
  options.seeds.resize(seeds);
  std::iota(options.seeds.begin(), options.seeds.end(), 1);
  ProgressBar bar(invocation.console, "section11");
  const InterruptScope interrupt;
  Hooks hooks;
  hooks.on_progress = [&](const Progress& progress) {
    bar.Show(progress.fraction, absl::StrCat("fit ", progress.iteration));
  };
  hooks.is_cancelled = [&] { return interrupt.interrupted(); };
  return Section11(options, hooks);
}

absl::Status RunSection11(const Invocation& invocation, int seeds) {
  if (seeds < 1 || seeds > kMostSeeds)
    return OptionFault("--seeds", absl::StrCat(seeds), absl::StrCat("1 to ", kMostSeeds));
  TRUEPOSE_ASSIGN_OR_RETURN(const Section11Result result, WithProgress(invocation, seeds));
  return Reply(invocation, Section11Json(result), [&] { return Section11Text(result); });
}

void AddTable2(const Command& reproduce) {
  struct Options {
    double q_deg = 40, q_next_deg = 25, l_mm = 320;
  };
  const auto options = std::make_shared<Options>();
  reproduce.Add("table2", "Columns of the Jacobian of two links, and their null relation")
      .Option("--q-deg", "DEG", &options->q_deg, "Of joint i")
      .Option("--q-next-deg", "DEG", &options->q_next_deg, "Of joint i+1")
      .Option("--l-mm", "MM", &options->l_mm, "Length of link i")
      .Footer("Example:\n  truepose reproduce table2 --q-deg 0 --l-mm 0")
      .Run(Command::Reach::kLocal, [options](const Invocation& invocation) {
        return RunTable2(invocation, options->q_deg, options->q_next_deg, options->l_mm);
      });
}

void AddSection11(const Command& reproduce) {
  const auto seeds = std::make_shared<int>(10);
  reproduce.Add("section11", "The calibration of a measuring robot, Tables 4 to 8")
      .Option("--seeds", "N", seeds.get(), "Simulated robots")
      .Footer(
          "Parameters are found by every estimator on 40, 60 and 81 poses of simulated robots.\n\n"
          "Example:\n  truepose reproduce section11 --seeds 3")
      .Run(Command::Reach::kLocal,
           [seeds](const Invocation& invocation) { return RunSection11(invocation, *seeds); });
}

}  // namespace

void AddReproduce(const Command& root) {
  const Command reproduce =
      root.Add("reproduce", "Run the examples of Fassi, Legnani, Tosi and Omodei's chapter");
  reproduce.Footer(
      "Examples:\n  truepose reproduce table2\n  truepose reproduce table3\n"
      "  truepose reproduce section11 --seeds 3");
  AddTable2(reproduce);
  reproduce.Add("table3", "The parameters of the Stanford arm in every model")
      .Footer("Example:\n  truepose reproduce table3")
      .Run(Command::Reach::kLocal, RunTable3);
  AddSection11(reproduce);
}

}  // namespace truepose::cli
