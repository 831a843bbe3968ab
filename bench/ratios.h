// Runs all registered benchmarks and prints, after their table, how long ours takes of what a peer takes.
#pragma once

#include <string>
#include <vector>

namespace truepose::bench {

// Names as the benchmarks are registered, with arguments ("Sweep", "Identify/81").
struct Ratio {
  std::string ours;
  std::string peer;
};

// @returns the exit code for main. Medians of the repetitions, in processor time, are compared; a name that was filtered out is left out.
int RunWithRatios(int argc, char** argv, const std::vector<Ratio>& ratios);

}  // namespace truepose::bench
