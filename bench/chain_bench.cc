// Pose, and pose with both Jacobians, of a UR10; beside automatic differentiation of the same chain.
#include <array>
#include <random>

#include <benchmark/benchmark.h>
#include <ceres/jet.h>

#include "bench/ratios.h"
#include "core/chain/chain.h"
#include "core/models/model.h"
#include "core/robot/dh.h"

namespace truepose::bench {
namespace {

constexpr double kQuarter = 1.5707963267948966;

Model Ur10() {
  const std::vector<JointType> types(6, JointType::kRevolute);
  const Chain chain = ChainFromStandardDh({{0, 0.1273, 0, kQuarter},
                                           {0, 0, -0.612, 0},
                                           {0, 0, -0.5723, 0},
                                           {0, 0.163941, 0, kQuarter},
                                           {0, 0.1157, 0, -kQuarter},
                                           {0, 0.0922, 0, 0}},
                                          types);
  const auto robot = Robot::Create(std::vector<Joint>(6), chain, JointMap::Identity(6));
  return ModifiedIncremental(robot.value(), ModelExtent::kInternal);
}

// Enough poses that sines are not the same every time, few enough for the cache.
std::vector<std::array<double, 6>> Poses() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(-1.5, 1.5);
  std::vector<std::array<double, 6>> poses(64);
  for (auto& q : poses) {
    for (double& value : q) value = angle(random);
  }
  return poses;
}

void Forward(benchmark::State& state) {
  const Model model = Ur10();
  const std::vector<double> lambda(model.parameters.size(), 1e-3);
  const auto poses = Poses();
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(truepose::Forward(model.chain, poses[i++ % poses.size()].data(), lambda.data()));
  }
}
BENCHMARK(Forward);

void Sweep(benchmark::State& state) {
  const Model model = Ur10();
  const std::vector<double> lambda(model.parameters.size(), 1e-3);
  const auto poses = Poses();
  truepose::Sweep sweep;
  size_t i = 0;
  for (auto _ : state) {
    RunSweep(model.chain, poses[i++ % poses.size()].data(), lambda.data(), &sweep);
    benchmark::DoNotOptimize(sweep.J_parameters.data());
  }
  state.counters["parameters"] = static_cast<double>(lambda.size());
}
BENCHMARK(Sweep);

void AutodiffSweep(benchmark::State& state) {
  using Jet = ceres::Jet<double, 32>;
  const Model model = Ur10();
  std::vector<Jet> lambda(model.parameters.size(), Jet(1e-3));
  for (size_t k = 0; k < lambda.size(); ++k) lambda[k] = Jet(1e-3, static_cast<int>(k % 26) + 6);
  const auto poses = Poses();
  size_t i = 0;
  for (auto _ : state) {
    const auto& q_value = poses[i++ % poses.size()];
    std::array<Jet, 6> q;
    for (int k = 0; k < 6; ++k) q[k] = Jet(q_value[k], k);
    benchmark::DoNotOptimize(truepose::Forward(model.chain, q.data(), lambda.data()));
  }
}
BENCHMARK(AutodiffSweep);

}  // namespace
}  // namespace truepose::bench

int main(int argc, char** argv) {
  return truepose::bench::RunWithRatios(argc, argv, {{"Sweep", "AutodiffSweep"}});
}
