// A compensation table of a UR10 (20 x 20 x 8 x 8 nodes, 0.6 MB, errors of about 1 mm): lookup of
// the twist, and the whole correction to joints, along a path and at random points. Beside a lookup
// that reads as it is defined, and exact compensation without a table.
#include <benchmark/benchmark.h>

#include "bench/peers/plain_lookup.h"
#include "bench/ratios.h"
#include "compensation/correct_by_table.h"
#include "compensation/encode_table.h"
#include "compensation/table_file.h"
#include "core/base/random.h"
#include "tests/compensation/table_samples.h"

namespace truepose::bench {
namespace {

using compensation::Delta;
using compensation::kMaxJoints;
using Joints = std::array<double, kMaxJoints>;

constexpr int kPoints = 4096;  // a controller's 8 s at 500 Hz; joints alone take 400 kB

const compensation::TableContent& Content() {
  static const compensation::TableContent* content = [] {
    auto* made = new compensation::TableContent(
        compensation::testing::Ur10Content(compensation::testing::Ur10Arm(3e-4), {20, 20, 8, 8}));
    compensation::testing::FillNodes(made);
    return made;
  }();
  return *content;
}

const compensation::Table& TableOfFile() {
  static const compensation::TableFile* file = [] {
    auto* read = new compensation::TableFile;
    if (!compensation::TableFile::Copy(compensation::Encode(Content()), {}, read).ok())
      std::abort();
    return read;
  }();
  return file->table();
}

std::vector<Joints> RandomPoints() {
  Random random(1);
  std::vector<Joints> points;
  for (int k = 0; k < kPoints; ++k) {
    std::vector<double> u;
    for (int i = 0; i < 6; ++i)
      u.push_back(random.Uniform(Content().axis[i].lower, Content().axis[i].upper));
    points.push_back(compensation::testing::JointsAt(Content(), u));
  }
  return points;
}

// To and fro through the domain, each coordinate at its own pace.
std::vector<Joints> Path() {
  std::vector<Joints> points;
  for (int k = 0; k < kPoints; ++k) {
    std::vector<double> u;
    for (int i = 0; i < 6; ++i) {
      const compensation::TableAxis& axis = Content().axis[i];
      const double share = 0.5 + 0.49 * std::sin(2 * M_PI * (i + 1) * k / kPoints + i);
      u.push_back(axis.lower + share * (axis.upper - axis.lower));
    }
    points.push_back(compensation::testing::JointsAt(Content(), u));
  }
  return points;
}

template <class Each>
void AtEach(benchmark::State& state, const std::vector<Joints>& points, Each each) {
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(each(points[i].data()));
    i = i + 1 == points.size() ? 0 : i + 1;
  }
}

Delta Found(const double* q) {
  return LookUp(TableOfFile(), q, compensation::Reach::kDomain).delta;
}

void LookUpOnPath(benchmark::State& state) { AtEach(state, Path(), Found); }
void LookUpAtRandom(benchmark::State& state) { AtEach(state, RandomPoints(), Found); }

void PlainLookUpOnPath(benchmark::State& state) {
  AtEach(state, Path(), [](const double* q) { return PlainLookUp(Content(), q); });
}

compensation::Correction Corrected(const double* q) { return CorrectByTable(TableOfFile(), q); }

void CorrectByTableOnPath(benchmark::State& state) { AtEach(state, Path(), Corrected); }
void CorrectByTableAtRandom(benchmark::State& state) { AtEach(state, RandomPoints(), Corrected); }

void CorrectExactlyOnPath(benchmark::State& state) {
  AtEach(state, Path(), [](const double* q) {
    return CorrectJoints(TableOfFile().arm, q, compensation::ExactOptions());
  });
}

// What the figures stand for: how many of the points were corrected, in how many steps.
void Counts(benchmark::State& state) {
  double corrected = 0, steps = 0, points = 0;
  for (auto _ : state) {
    corrected = steps = points = 0;
    for (const Joints& q : RandomPoints()) {
      const compensation::Correction found = Corrected(q.data());
      corrected += found.outcome == compensation::Outcome::kOk ? 1 : 0;
      steps += found.iterations;
      ++points;
    }
  }
  state.counters["corrected"] = corrected / points;
  state.counters["steps"] = steps / points;
}

BENCHMARK(LookUpOnPath);
BENCHMARK(LookUpAtRandom);
BENCHMARK(PlainLookUpOnPath);
BENCHMARK(CorrectByTableOnPath);
BENCHMARK(CorrectByTableAtRandom);
BENCHMARK(CorrectExactlyOnPath);
BENCHMARK(Counts)->Iterations(1);

}  // namespace
}  // namespace truepose::bench

int main(int argc, char** argv) {
  return truepose::bench::RunWithRatios(
      argc, argv,
      {{"LookUpOnPath", "PlainLookUpOnPath"}, {"CorrectByTableOnPath", "CorrectExactlyOnPath"}});
}
