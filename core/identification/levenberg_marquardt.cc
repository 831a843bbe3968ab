#include "core/identification/levenberg_marquardt.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <memory>

#include "core/identification/prediction.h"

namespace truepose {
namespace {

using Corrections = std::vector<std::array<double, kFrameParameters>>;

// One reading as a residual block over (base corrections, tool corrections, internal parameters).
class ReadingCost final : public ceres::CostFunction {
 public:
  ReadingCost(const Model& model, const Reading& reading, const Pose& X_MB, const Pose& X_FT,
              const ModelError& model_error, Workspace* workspace)
      : model_(model),
        reading_(reading),
        X_MB_(X_MB),
        X_FT_(X_FT),
        weight_(StandardDeviations(reading, model_error).cwiseInverse()),
        workspace_(workspace) {
    set_num_residuals(RowsOf(reading));
    *mutable_parameter_block_sizes() = {kFrameParameters, kFrameParameters,
                                        model.parameters.size()};
  }

  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    Residual r;
    ReadingJacobian J;
    EvaluateReading(model_, reading_, X_MB_, X_FT_, p[0], p[1], p[2], workspace_, &r,
                    jacobians == nullptr ? nullptr : &J);
    Eigen::Map<Eigen::VectorXd>(residuals, r.size()) = weight_.cwiseProduct(r);
    if (jacobians == nullptr) return true;
    CopyTo(J.base, jacobians[0]);
    CopyTo(J.tool, jacobians[1]);
    CopyTo(J.internal, jacobians[2]);
    return true;
  }

 private:
  void CopyTo(const RowJacobian& J, double* out) const {
    if (out == nullptr) return;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        out, J.rows(), J.cols()) = weight_.asDiagonal() * J;
  }

  const Model& model_;
  const Reading& reading_;
  const Pose &X_MB_, &X_FT_;
  const Residual weight_;
  Workspace* const workspace_;  // the solver runs in one thread: same inputs, same bits
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

void MoveFrames(const Corrections& corrections, std::vector<Pose>* frames) {
  for (size_t i = 0; i < frames->size(); ++i) {
    (*frames)[i] = Corrected((*frames)[i], corrections[i].data(), nullptr);
    (*frames)[i].R =
        NearestRotation((*frames)[i].R);  // products of rotations drift from orthogonality
  }
}

// The solver's view of a problem: its blocks of variables and one residual block a reading.
class Blocks {
 public:
  Blocks(const Problem& problem, const ModelError& model_error, const std::vector<int>& active,
         const Estimate& start)
      : base_(problem.placements.size()), tool_(problem.targets.size()), lambda_(start.lambda) {
    ceres::Problem::Options options;
    solver_ = std::make_unique<ceres::Problem>(options);
    for (const Reading& reading : problem.readings) {
      solver_->AddResidualBlock(
          new ReadingCost(*problem.model, reading, start.X_MB[reading.placement],
                          start.X_FT[reading.target], model_error, &workspace_),
          nullptr, base_[reading.placement].data(), tool_[reading.target].data(), lambda_.data());
    }
    Hold(problem, active);
  }

  ceres::Problem* solver() { return solver_.get(); }

  void WriteTo(Estimate* estimate) const {
    MoveFrames(base_, &estimate->X_MB);
    MoveFrames(tool_, &estimate->X_FT);
    estimate->lambda = lambda_;
  }

 private:
  void Hold(const Problem& problem, const std::vector<int>& active) {
    std::vector<bool> is_active(problem.CandidateCount(), false);
    for (int index : active) is_active[index] = true;
    for (size_t i = 0; i < base_.size(); ++i) {
      HoldInactive(is_active, problem.FirstOfBase(static_cast<int>(i)), kFrameParameters,
                   base_[i].data(), solver_.get());
    }
    for (size_t i = 0; i < tool_.size(); ++i) {
      HoldInactive(is_active, problem.FirstOfTool(static_cast<int>(i)), kFrameParameters,
                   tool_[i].data(), solver_.get());
    }
    HoldInactive(is_active, problem.FirstInternal(), static_cast<int>(lambda_.size()),
                 lambda_.data(), solver_.get());
  }

  Corrections base_, tool_;
  Eigen::VectorXd lambda_;
  Workspace workspace_;
  std::unique_ptr<ceres::Problem> solver_;
};

}  // namespace

const char* Name(Termination termination) {
  switch (termination) {
    case Termination::kConverged:
      return "converged";
    case Termination::kIterationLimit:
      return "iteration_limit";
    case Termination::kCancelled:
      return "cancelled";
    case Termination::kFailed:
      break;
  }
  return "failed";
}

SolveSummary Minimise(const Problem& problem, const ModelError& model_error,
                      const std::vector<int>& active, const SolveOptions& options,
                      const Hooks& hooks, Estimate* estimate) {
  Blocks blocks(problem, model_error, active, *estimate);
  HooksCallback callback(hooks);
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(options, blocks.solver()->NumResiduals(), &callback), blocks.solver(),
               &summary);
  SolveSummary result{TerminationOf(summary, hooks), static_cast<int>(summary.iterations.size()),
                      summary.initial_cost, summary.final_cost, summary.message};
  if (summary.IsSolutionUsable()) blocks.WriteTo(estimate);
  return result;
}

}  // namespace truepose
