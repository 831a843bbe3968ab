#include "core/identification/levenberg_marquardt.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <memory>

#include "core/identification/candidate_values.h"

namespace truepose {
namespace {

// One reading as a residual block over (base corrections, tool corrections, internal parameters
// [, constant of a distance]).
class ReadingCost final : public ceres::CostFunction {
 public:
  ReadingCost(const Model& model, const Reading& reading, const Estimate& start,
              const ResidualMatrix& whitener, Workspace* workspace)
      : model_(model),
        reading_(reading),
        start_(PointOf(reading, start)),
        whitener_(whitener),
        workspace_(workspace) {
    set_num_residuals(RowsOf(reading));
    *mutable_parameter_block_sizes() = {kFrameParameters, kFrameParameters,
                                        model.parameters.size()};
    if (reading.offset >= 0) mutable_parameter_block_sizes()->push_back(1);
  }

  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    Residual r;
    ReadingJacobian J;
    const bool has_offset = reading_.offset >= 0;
    const ReadingPoint at = {start_.X_MB, start_.X_FT, p[0], p[1], has_offset ? *p[3] : 0, p[2]};
    EvaluateReading(model_, reading_, at, workspace_, &r, jacobians == nullptr ? nullptr : &J);
    Eigen::Map<Eigen::VectorXd>(residuals, r.size()) = whitener_ * r;
    if (jacobians == nullptr) return true;
    CopyTo(J.base, jacobians[0]);
    CopyTo(J.tool, jacobians[1]);
    CopyTo(J.internal, jacobians[2]);
    if (has_offset) CopyTo(J.offset, jacobians[3]);
    return true;
  }

 private:
  void CopyTo(const RowJacobian& J, double* out) const {
    if (out == nullptr) return;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        out, J.rows(), J.cols()) = whitener_ * J;
  }

  const Model& model_;
  const Reading& reading_;
  const ReadingPoint start_;
  const ResidualMatrix whitener_;
  Workspace* const workspace_;  // the solver runs in one thread: same inputs, same bits
};

// The prior's rows, root (mean - lambda).
class PriorCost final : public ceres::CostFunction {
 public:
  explicit PriorCost(const Prior& prior) : prior_(prior) {
    set_num_residuals(static_cast<int>(prior.root.rows()));
    *mutable_parameter_block_sizes() = {static_cast<int>(prior.root.cols())};
  }

  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    const Eigen::Map<const Eigen::VectorXd> lambda(p[0], prior_.root.cols());
    Eigen::Map<Eigen::VectorXd>(residuals, prior_.root.rows()) =
        prior_.root * (prior_.mean - lambda);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        jacobians[0], prior_.root.rows(), prior_.root.cols()) = -prior_.root;
    return true;
  }

 private:
  const Prior& prior_;
};

class HooksCallback final : public ceres::IterationCallback {
 public:
  explicit HooksCallback(const Hooks& hooks) : hooks_(hooks) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    hooks_.Report({"identification", 0, summary.iteration, summary.cost});
    return hooks_.Cancelled() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const Hooks& hooks_;
};

// Holds the candidates of one block that are not active. @param first the block's first candidate.
void HoldInactive(const std::vector<bool>& is_active, int first, int size, double* block,
                  ceres::Problem* solver) {
  if (size == 0 || !solver->HasParameterBlock(block)) return;
  std::vector<int> held;
  for (int i = 0; i < size; ++i) {
    if (!is_active[first + i]) held.push_back(i);
  }
  if (static_cast<int>(held.size()) == size) {
    solver->SetParameterBlockConstant(block);
  } else if (!held.empty()) {
    solver->SetManifold(block, new ceres::SubsetManifold(size, held));
  }
}

// Up to this many rows QR costs nothing, and it takes the degenerate systems of tiny sessions
// without complaint.
constexpr int kRowsForQr = 400;

ceres::Solver::Options SolverOptions(const SolveOptions& options, int rows,
                                     HooksCallback* callback) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = rows <= kRowsForQr ? ceres::DENSE_QR : ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.function_tolerance;
  solver.parameter_tolerance = options.parameter_tolerance;
  solver.gradient_tolerance = 0;  // the gradient has mixed units; cost and step decide
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  solver.callbacks.push_back(callback);
  return solver;
}

Termination TerminationOf(const ceres::Solver::Summary& summary, const Hooks& hooks) {
  if (summary.termination_type == ceres::CONVERGENCE) return Termination::kConverged;
  if (summary.termination_type == ceres::NO_CONVERGENCE) return Termination::kIterationLimit;
  return hooks.Cancelled() ? Termination::kCancelled : Termination::kFailed;
}

// The solver's view of a problem: its blocks of variables are parts of the candidates' values, one
// residual block a reading, and the prior's.
class Blocks {
 public:
  Blocks(const Problem& problem, const ModelError& model_error, const std::vector<int>& active,
         const Estimate& start)
      : values_(ValuesOf(problem, start)), solver_(std::make_unique<ceres::Problem>()) {
    for (const Reading& reading : problem.readings) {
      solver_->AddResidualBlock(
          new ReadingCost(*problem.model, reading, start,
                          WhitenerOf(problem, reading, start, model_error), &workspace_),
          nullptr, BlocksOf(problem, reading));
    }
    if (problem.prior) {
      solver_->AddResidualBlock(new PriorCost(*problem.prior), nullptr,
                                values_.data() + problem.FirstInternal());
    }
    Hold(problem, active);
  }

  ceres::Problem* solver() { return solver_.get(); }
  const Eigen::VectorXd& values() const { return values_; }

 private:
  std::vector<double*> BlocksOf(const Problem& problem, const Reading& reading) {
    std::vector<double*> blocks = {values_.data() + problem.FirstOfBase(reading.placement),
                                   values_.data() + problem.FirstOfTool(reading.target),
                                   values_.data() + problem.FirstInternal()};
    if (reading.offset >= 0)
      blocks.push_back(values_.data() + problem.FirstOfOffsets() + reading.offset);
    return blocks;
  }

  void Hold(const Problem& problem, const std::vector<int>& active) {
    std::vector<bool> is_active(problem.CandidateCount(), false);
    for (int index : active) is_active[index] = true;
    const auto hold = [&](int first, int size) {
      HoldInactive(is_active, first, size, values_.data() + first, solver_.get());
    };
    for (int i = 0; i < problem.FirstOfOffsets(); i += kFrameParameters) hold(i, kFrameParameters);
    for (int i = problem.FirstOfOffsets(); i < problem.FirstInternal(); ++i) hold(i, 1);
    hold(problem.FirstInternal(), problem.model->parameters.size());
  }

  Eigen::VectorXd values_;
  Workspace workspace_;
  std::unique_ptr<ceres::Problem> solver_;
};

}  // namespace

SolveSummary Minimise(const Problem& problem, const ModelError& model_error,
                      const std::vector<int>& active, const SolveOptions& options,
                      const Hooks& hooks, Estimate* estimate) {
  Blocks blocks(problem, model_error, active, *estimate);
  HooksCallback callback(hooks);
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(options, blocks.solver()->NumResiduals(), &callback), blocks.solver(),
               &summary);
  SolveSummary result;
  result.termination = TerminationOf(summary, hooks);
  result.iterations = static_cast<int>(summary.iterations.size());
  result.initial_cost = summary.initial_cost;
  result.final_cost = summary.final_cost;
  result.message = summary.message;
  if (summary.IsSolutionUsable()) *estimate = EstimateAt(problem, *estimate, blocks.values());
  return result;
}

}  // namespace truepose
