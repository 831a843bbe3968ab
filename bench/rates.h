// Runs all registered benchmarks and prints, after their table, how many times a peer's items a
// second ours reaches in the same run.
#pragma once

#include <string>
#include <vector>

namespace truepose::bench {

// Names of benchmarks that set items processed; `wanted` is what ours is to reach at
// least, 0 when the peer is there for orientation only.
struct RateRatio {
  std::string ours;
  std::string peer;
  double wanted = 1;
};

// @returns the exit code for main. Medians and bests of the repetitions are compared.
int RunWithRates(int argc, char** argv, const std::vector<RateRatio>& ratios);

}  // namespace truepose::bench
