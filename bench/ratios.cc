#include "bench/ratios.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include <benchmark/benchmark.h>

namespace truepose::bench {
namespace {

// Prints as usual and keeps the processor seconds of each run, which a busy machine does not change.
class KeepingReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration && !run.error_occurred && run.iterations > 0) {
        seconds_[NameOf(run)].push_back(run.cpu_accumulated_time / static_cast<double>(run.iterations));
      }
    }
    ConsoleReporter::ReportRuns(runs);
  }

  // 0 when there was no such run.
  double Median(const std::string& name) const {
    const auto found = seconds_.find(name);
    if (found == seconds_.end()) return 0;
    std::vector<double> sorted = found->second;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }

 private:
  static std::string NameOf(const Run& run) {
    const std::string& name = run.run_name.function_name;
    return run.run_name.args.empty() ? name : name + "/" + run.run_name.args;
  }

  std::map<std::string, std::vector<double>> seconds_;
};

}  // namespace

int RunWithRatios(int argc, char** argv, const std::vector<Ratio>& ratios) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  KeepingReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  for (const Ratio& ratio : ratios) {
    const double ours = reporter.Median(ratio.ours), peer = reporter.Median(ratio.peer);
    if (ours > 0 && peer > 0) {
      std::printf("%s takes %.3f of the time of %s\n", ratio.ours.c_str(), ours / peer, ratio.peer.c_str());
    }
  }
  return 0;
}

}  // namespace truepose::bench
