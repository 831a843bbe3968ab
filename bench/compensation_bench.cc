// Exact compensation of single targets of a UR10 beside Orocos KDL's inverse kinematics of the same
// identified chain from the same start. Targets are random (0.5 rad about a working pose, sigma_min
// far from a singularity) or follow one another along a path; one target a call, no batches.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>
#include <vector>

#include "bench/peers/kdl_inverse.h"
#include "bench/ratios.h"
#include "compensation/exact.h"
#include "compensation/inverse.h"

namespace truepose::bench {
namespace {

using compensation::Arm;
using compensation::Correction;
using compensation::JointArray;
using compensation::Outcome;

constexpr int kTargets = 1024;

Pose DhPose(double d, double a, double alpha) {
  return {Eigen::AngleAxisd(alpha, Eigen::Vector3d::UnitX()).toRotationMatrix(), {a, 0, d}};
}

// UR10 with errors of 0.5 mrad and 0.5 mm (one sigma) of every link: about 1 mm at the flange.
Arm Ur10() {
  const double r = std::numbers::pi / 2;
  Arm arm;
  arm.nominal.joints = 6;
  arm.nominal.constant = {Pose{},
                          DhPose(.1273, 0, r),
                          DhPose(0, -.612, 0),
                          DhPose(0, -.5723, 0),
                          DhPose(.163941, 0, r),
                          DhPose(.1157, 0, -r),
                          DhPose(.0922, 0, 0)};
  arm.identified = arm.nominal;
  std::mt19937 generator(1);
  std::normal_distribution<double> error(0, 5e-4);
  const auto draw = [&] {
    const double x = error(generator), y = error(generator), z = error(generator);
    return Eigen::Vector3d(x, y, z);
  };
  for (int i = 0; i <= 6; ++i) {
    Pose& C = arm.identified.constant[i];
    C.R = C.R * ExpRotation<double>(draw());
    C.p += draw();
  }
  for (int i = 0; i < 6; ++i) arm.limits[i] = {-2 * std::numbers::pi, 2 * std::numbers::pi};
  return arm;
}

const JointArray kHome = {0, -1.4, 1.8, -1.9, -1.6, 0};

std::vector<JointArray> RandomTargets() {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> shift(-0.5, 0.5);
  std::vector<JointArray> targets(kTargets, kHome);
  for (JointArray& q : targets) {
    for (int i = 0; i < 6; ++i) q[i] += shift(generator);
  }
  return targets;
}

// A closed curve in joint space.
std::vector<JointArray> PathTargets() {
  std::vector<JointArray> targets(kTargets, kHome);
  for (int k = 0; k < kTargets; ++k) {
    for (int i = 0; i < 6; ++i)
      targets[k][i] += 0.5 * std::sin(2 * std::numbers::pi * k / kTargets + i);
  }
  return targets;
}

// A figure of targets that were not reached would be worth nothing.
void CheckReached(const Arm& arm, const Pose& X, const double* q, benchmark::State* state) {
  const auto e = compensation::Remainder(X, IdentifiedFlange(arm, q));
  if (e.head<3>().norm() > 1e-8 || e.tail<3>().norm() > 1e-8)
    state->SkipWithError("a target was not reached");
}

void Exact(benchmark::State& state, const std::vector<JointArray>& targets) {
  const Arm arm = Ur10();
  size_t k = 0;
  double iterations = 0;
  Correction correction;
  for (auto _ : state) {
    correction = CorrectJoints(arm, targets[k++ % kTargets].data(), {});
    iterations += correction.iterations;
    benchmark::DoNotOptimize(correction);
  }
  state.counters["steps"] = iterations / static_cast<double>(state.iterations());
  for (const JointArray& q : targets)
    CheckReached(arm, NominalFlange(arm, q.data()), CorrectJoints(arm, q.data(), {}).q.data(),
                 &state);
}

void ExactRandom(benchmark::State& state) { Exact(state, RandomTargets()); }
BENCHMARK(ExactRandom);

void ExactPath(benchmark::State& state) { Exact(state, PathTargets()); }
BENCHMARK(ExactPath);

void KdlRandom(benchmark::State& state) {
  const Arm arm = Ur10();
  KdlInverse kdl(arm.identified);
  const auto targets = RandomTargets();
  JointArray q;
  size_t k = 0;
  for (auto _ : state) {
    const JointArray& target = targets[k++ % kTargets];
    benchmark::DoNotOptimize(kdl.Solve(NominalFlange(arm, target.data()), target.data(), q.data()));
  }
  // How exact the peer is, said beside its time: it stops earlier than ours.
  double worst = 0;
  int refused = 0;
  for (const JointArray& target : targets) {
    const Pose X = NominalFlange(arm, target.data());
    refused += kdl.Solve(X, target.data(), q.data()) ? 0 : 1;
    worst = std::max(worst, compensation::Remainder(X, IdentifiedFlange(arm, q.data())).norm());
  }
  state.counters["worst_left"] = worst;  // m and rad
  state.counters["refused"] = refused;
}
BENCHMARK(KdlRandom);

// Inverse kinematics as KDL is mostly used: from a start that is not near.
void KdlFromHome(benchmark::State& state) {
  const Arm arm = Ur10();
  KdlInverse kdl(arm.identified);
  const auto targets = RandomTargets();
  JointArray q;
  size_t k = 0;
  for (auto _ : state) {
    const Pose X = NominalFlange(arm, targets[k++ % kTargets].data());
    benchmark::DoNotOptimize(kdl.Solve(X, kHome.data(), q.data()));
  }
}
BENCHMARK(KdlFromHome);

void PoseFromHome(benchmark::State& state) {
  const Arm arm = Ur10();
  const auto targets = RandomTargets();
  size_t k = 0;
  for (auto _ : state) {
    const Pose X = NominalFlange(arm, targets[k++ % kTargets].data());
    benchmark::DoNotOptimize(CorrectPose(arm, X, kHome.data(), {}));
  }
}
BENCHMARK(PoseFromHome);

}  // namespace
}  // namespace truepose::bench

int main(int argc, char** argv) {
  return truepose::bench::RunWithRatios(
      argc, argv,
      {{"ExactRandom", "KdlRandom"}, {"ExactPath", "KdlRandom"}, {"PoseFromHome", "KdlFromHome"}});
}
