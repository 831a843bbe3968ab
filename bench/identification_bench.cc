// The arm6 problem (30 parameters, 81 and 1,000 poses) beside a plain Ceres solve with automatic differentiation.
//
// Solve is what the peer does too: from known frames and a known set of parameters to the minimum. Calibrate is the
// whole of ours: frames from nothing, identifiability, weights from the residuals, covariance, before and after.
// `held_out_mm` is the RMS position error on 500 noise-free poses, so that a wrong minimum would be seen.
#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <benchmark/benchmark.h>

#include "bench/peers/autodiff_solve.h"
#include "bench/ratios.h"
#include "bench/shared_problem.h"
#include "core/calibrate/calibrate.h"
#include "core/identification/levenberg_marquardt.h"
#include "core/identification/prediction.h"
#include "core/models/model.h"
#include "core/robot/dh.h"

namespace truepose::bench {
namespace {

constexpr int kJoints = 6;
constexpr int kHeldOutPoses = 500;

Robot NominalRobot(const SharedProblem& shared) {
  std::vector<DhRow> rows;
  for (int i = 0; i < kJoints; ++i) {
    const double* p = &shared.nominal[4 + 5 * i];
    rows.push_back({p[0], p[1], p[2], p[3]});
  }
  const std::vector<JointType> types(kJoints, JointType::kRevolute);
  return Robot::Create(std::vector<Joint>(kJoints), ChainFromStandardDh(rows, types), JointMap::Identity(kJoints)).value();
}

Reading ToReading(const MeasuredPose& pose) {
  Reading reading;
  reading.q = Eigen::Map<const Eigen::VectorXd>(pose.q.data(), kJoints);
  reading.X_MT.p = Eigen::Vector3d(pose.p_m.data());
  reading.X_MT.R = Eigen::Quaterniond(pose.wxyz[0], pose.wxyz[1], pose.wxyz[2], pose.wxyz[3]).toRotationMatrix();
  return reading;
}

// The robot and the readings of a problem, as Calibrate takes them; all rows calibrate.
struct Ours {
  explicit Ours(const SharedProblem& shared) : robot(NominalRobot(shared)) {
    problem.robot = &robot;
    for (const MeasuredPose& pose : shared.poses) problem.readings.push_back(ToReading(pose));
    problem.calibrates.assign(problem.readings.size(), true);
    problem.placements = {""};
    problem.targets = {""};
  }

  CalibrationResult Run() const { return truepose::Calibrate(problem, {}, {}).value(); }

  Robot robot;
  CalibrationProblem problem;
};

template <typename Tip>
double HeldOutMm(const SharedProblem& shared, const Tip& tip) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> angle(-1.5, 1.5);
  double squares = 0;
  std::vector<double> q(kJoints);
  for (int i = 0; i < kHeldOutPoses; ++i) {
    for (double& value : q) value = angle(random);
    const auto truth = TipOf(shared.truth, q), found = tip(q);
    for (int k = 0; k < 3; ++k) squares += std::pow(truth[k] - found[k], 2);
  }
  return 1e3 * std::sqrt(squares / kHeldOutPoses);
}

double HeldOutMm(const SharedProblem& shared, const CalibrationResult& result, const Problem& problem) {
  Reading reading;
  return HeldOutMm(shared, [&](const std::vector<double>& q) {
    reading.q = Eigen::Map<const Eigen::VectorXd>(q.data(), kJoints);
    const Eigen::Vector3d p = Predict(problem, reading, result.identification.estimate).p;
    return std::array<double, 3>{p.x(), p.y(), p.z()};
  });
}

Problem ProblemOf(const Ours& ours, const Model& model) {
  return {&model, ours.problem.readings, ours.problem.placements, ours.problem.targets};
}

void Calibrate(benchmark::State& state) {
  const SharedProblem shared = ReadSharedProblem("arm6", static_cast<int>(state.range(0)));
  const Ours ours(shared);
  for (auto _ : state) benchmark::DoNotOptimize(ours.Run());
  const CalibrationResult result = ours.Run();
  state.counters["held_out_mm"] = HeldOutMm(shared, result, ProblemOf(ours, result.model));
}

void Solve(benchmark::State& state) {
  const SharedProblem shared = ReadSharedProblem("arm6", static_cast<int>(state.range(0)));
  const Ours ours(shared);
  const CalibrationResult result = ours.Run();
  const Problem problem = ProblemOf(ours, result.model);
  for (auto _ : state) {
    Estimate estimate = result.before.estimate;
    benchmark::DoNotOptimize(Minimise(problem, result.identification.model_error, result.identification.set.active, {},
                                      {}, &estimate));
  }
}

// The four estimators on one weighted problem, 81 poses; `cost_over_least` says how near each came.
void SolveBy(benchmark::State& state, Estimator estimator) {
  const SharedProblem shared = ReadSharedProblem("arm6", 81);
  const Ours ours(shared);
  const CalibrationResult result = ours.Run();
  const Problem problem = ProblemOf(ours, result.model);
  const auto solve = [&](Estimator by) {
    SolveOptions options;
    options.estimator = by;
    Estimate estimate = result.before.estimate;
    return truepose::Solve(problem, result.identification.model_error, result.identification.set.active, options, {},
                           &estimate);
  };
  for (auto _ : state) benchmark::DoNotOptimize(solve(estimator));
  const SolveSummary summary = solve(estimator);
  state.counters["iterations"] = summary.iterations;
  state.counters["cost_over_least"] = summary.final_cost / solve(Estimator::kLevenbergMarquardt).final_cost;
}

void AutodiffSolve(benchmark::State& state) {
  const SharedProblem shared = ReadSharedProblem("arm6", static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(bench::AutodiffSolve(shared));
  const std::vector<double> found = bench::AutodiffSolve(shared);
  state.counters["held_out_mm"] = HeldOutMm(shared, [&](const std::vector<double>& q) { return TipOf(found, q); });
}

BENCHMARK(Calibrate)->Arg(81)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(Solve)->Arg(81)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(SolveBy, levenberg_marquardt, Estimator::kLevenbergMarquardt)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(SolveBy, linear_iteration, Estimator::kLinearIteration)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(SolveBy, kalman, Estimator::kKalman)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(SolveBy, simplex, Estimator::kSimplex)->Unit(benchmark::kMillisecond);
BENCHMARK(AutodiffSolve)->Arg(81)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace truepose::bench

int main(int argc, char** argv) {
  return truepose::bench::RunWithRatios(argc, argv,
                                        {{"Solve/81", "AutodiffSolve/81"},
                                         {"Solve/1000", "AutodiffSolve/1000"},
                                         {"Calibrate/81", "AutodiffSolve/81"},
                                         {"Calibrate/1000", "AutodiffSolve/1000"},
                                         {"SolveBy/linear_iteration", "SolveBy/levenberg_marquardt"},
                                         {"SolveBy/kalman", "SolveBy/levenberg_marquardt"},
                                         {"SolveBy/simplex", "SolveBy/levenberg_marquardt"}});
}
