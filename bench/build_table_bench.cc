// A compensation table of a UR10, estimated, and built and verified: 1 m^3 in front of the robot, tool down within
// 30 deg, 0.02 mm and 0.005 deg (experiments E5), errors of some 1 mm. The limit is 3 s.
#include <iostream>

#include <benchmark/benchmark.h>

#include "core/compensation/build_table.h"
#include "tests/core/compensation/drawn_arm.h"
#include "tests/core/testing/robots.h"

namespace truepose::bench {
namespace {

TableSpec Volume() {
  TableSpec spec;
  spec.box.emplace();
  spec.box->box_B = {Eigen::Vector3d(.30, -.70, 0), Eigen::Vector3d(1.05, .70, .95)};
  spec.box->cone_rad = 30 * testing::kDeg;
  spec.box->reference = (Eigen::VectorXd(6) << 3.14, -1.2, 1.8, -2.17, -1.57, 0).finished();
  return spec;
}

void EstimateTable(benchmark::State& state) {
  const compensation::Arm arm = testing::DrawnArm(testing::Ur10(), 1, 5e-4, 5e-4);
  for (auto _ : state) benchmark::DoNotOptimize(truepose::EstimateTable(arm, Volume()));
}
BENCHMARK(EstimateTable)->Unit(benchmark::kMillisecond);

void BuildAndVerifyTable(benchmark::State& state) {
  const compensation::Arm arm = testing::DrawnArm(testing::Ur10(), 1, 5e-4, 5e-4);
  for (auto _ : state) {
    const auto built = BuildTable(arm, Volume(), {}, {});
    if (!built.ok()) {
      std::cerr << built.status() << "\n";
      return state.SkipWithError("no table was built");
    }
    state.counters["MB"] = static_cast<double>(built->estimate.bytes) / 1e6;
    state.counters["worst_um"] = 1e6 * built->content.header.worst.position_m;
    state.counters["near_singular_percent"] = 100 * built->content.header.near_singular_share;
  }
}
BENCHMARK(BuildAndVerifyTable)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace truepose::bench

BENCHMARK_MAIN();
