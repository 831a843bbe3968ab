#include "bench/rates.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <thread>

namespace truepose::bench {
namespace {

// Prints as usual and keeps the items a second of each run.
class KeepingReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      const auto rate = run.counters.find("items_per_second");
      if (run.run_type == Run::RT_Iteration && rate != run.counters.end()) {
        rates_[run.run_name.function_name].push_back(rate->second.value);
      }
    }
    ConsoleReporter::ReportRuns(runs);
  }

  // Ascending; empty when there was no such run.
  std::vector<double> RatesOf(const std::string& name) const {
    const auto found = rates_.find(name);
    if (found == rates_.end()) return {};
    std::vector<double> sorted = found->second;
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }

 private:
  std::map<std::string, std::vector<double>> rates_;
};

void Print(const RateRatio& ratio, const std::vector<double>& ours,
           const std::vector<double>& peer) {
  if (ours.empty() || peer.empty()) return;
  const double median = ours[ours.size() / 2], of = peer[peer.size() / 2];
  const std::string wanted =
      ratio.wanted > 0 ? ", wanted " + std::to_string(ratio.wanted).substr(0, 4) : "";
  std::printf("%s %.0f/s, %s %.0f/s: ratio of medians %.2f, of bests %.2f%s\n", ratio.ours.c_str(),
              median, ratio.peer.c_str(), of, median / of, ours.back() / peer.back(),
              wanted.c_str());
}

}  // namespace

int RunWithRates(int argc, char** argv, const std::vector<RateRatio>& ratios) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  KeepingReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  std::printf("%u cores, shared by server and clients\n", std::thread::hardware_concurrency());
  for (const RateRatio& ratio : ratios) {
    Print(ratio, reporter.RatesOf(ratio.ours), reporter.RatesOf(ratio.peer));
  }
  return 0;
}

}  // namespace truepose::bench
