#include "compensation/least_squares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace truepose::compensation {
namespace {

using Wide = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, kMaxJoints>;
using Square =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxJoints, kMaxJoints>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxJoints, 1>;

constexpr double kLongestStep = 0.5;  // rad: a start from far away comes in pieces
constexpr double kNothing = 1e-13;    // a step that no encoder sees
constexpr double kFirstDamping = 1e-6, kMostDamping = 1e6, kLeastDamping = 1e-9;
// Keeps the normal matrix regular where a joint moves nothing; a step lacks 1e-14 of itself by it.
constexpr double kRegular = 1e-14;
constexpr double kRounding = 1e-14;
constexpr int kGaussNewtons = 6;  // before the whole second derivative is taken
constexpr double kBeside = 1e-5;  // rad or length_m, of differences of the gradient
constexpr int kMostDraws = 30;

// One place of the joints: remainder, and its derivative by the free joints without units.
struct Place {
  Vector v;
  Twist e, weighted;
  Wide A;
};

class Solver {
 public:
  Solver(const LeastSquaresTask& task, const double* start) : task_(task) {
    const int n = task.chain->joints;
    unit_.resize(n);
    for (int i = 0; i < n; ++i) unit_(i) = task.chain->prismatic[i] ? task.length_m : 1;
    now_.v = Eigen::Map<const Eigen::VectorXd>(start, n);
  }

  LeastSquaresResult Solve() {
    Evaluate(&now_);
    LeastSquaresResult result;
    double damping = 0;
    bool small = false;
    while (!Reached() && !small && result.iterations < task_.max_iterations) {
      ++result.iterations;
      const Vector step = Limited(StepOf(damping, result.iterations));
      damping = Try(step) ? Eased(damping) : std::max(10 * damping, kFirstDamping);
      small = IsNothing(step) || damping > kMostDamping;
    }
    result.reached = Reached();
    result.settled = result.reached || small;
    Fill(&result);
    return result;
  }

  // Undamped: J^+ (e + J (v - reference)) - (v - reference) from a place that is a solution.
  LeastSquaresResult Draw(const double* reference, const LeastSquaresResult& given) {
    LeastSquaresResult result = given;
    Evaluate(&now_);
    for (int draw = 0; draw < kMostDraws; ++draw) {
      const Vector step = TowardsStep(Eigen::Map<const Eigen::VectorXd>(reference, now_.v.size()));
      now_.v += step.cwiseProduct(unit_) * ShareOf(step);
      Evaluate(&now_);
      ++result.iterations;
      if (!now_.v.allFinite() || !IsSettled(step)) continue;
      if (!Reached()) return given;
      Fill(&result);
      return result;
    }
    return given;
  }

 private:
  void Evaluate(Place* place) const {
    const JointChain& chain = *task_.chain;
    JointArray q_chain;
    ToChain(*task_.arm, place->v.data(), q_chain.data());
    Motions motions;
    SetMotions(chain, q_chain.data(), &motions);
    Sweep sweep;
    RunSweep(chain, motions, &sweep);
    const Eigen::Vector3d arm_B = sweep.X_BF.R * task_.point_F;
    const Eigen::Matrix3d R_DB = task_.desired.R.transpose();
    const Twist left = Remainder(task_.desired, sweep.X_BF);
    place->e << R_DB * (left.head<3>() + task_.desired.R * task_.point_F - arm_B),
        R_DB * left.tail<3>();
    place->weighted = task_.weight.cwiseProduct(place->e);
    Wide J = JacobianOf(chain, sweep)
                 .lazyProduct(task_.arm->joint_scale.topLeftCorner(chain.joints, chain.joints));
    const Eigen::Matrix3d turn = R_DB * RightJacobianInverse(left.tail<3>());
    for (int i = 0; i < chain.joints; ++i) {
      const Eigen::Vector3d omega = J.col(i).tail<3>();
      J.col(i).head<3>() = R_DB * (J.col(i).head<3>() + omega.cross(arm_B));
      J.col(i).tail<3>() = turn * omega;
    }
    place->A = task_.weight.asDiagonal() * J * unit_.asDiagonal();
    for (int i = 0; i < chain.joints; ++i) {
      if (task_.held[i]) place->A.col(i).setZero();
    }
  }

  bool Reached() const {
    return now_.e.head<3>().norm() <= task_.position_tolerance_m &&
           now_.e.tail<3>().norm() <= task_.rotation_tolerance_rad;
  }

  int FreeJoints() const {
    int free = 0;
    for (int i = 0; i < task_.chain->joints; ++i) free += task_.held[i] ? 0 : 1;
    return free;
  }

  // A^T (A A^T + d I)^-1 b, with as few rows as there are; b a twist.
  Vector LeastChange(const Twist& b, double damping) const {
    Eigen::Matrix<double, 6, 6> normal = now_.A.lazyProduct(now_.A.transpose());
    const double largest = normal.diagonal().maxCoeff();
    normal.diagonal().array() += (damping + kRegular) * largest;
    const Twist y = normal.ldlt().solve(b);
    return now_.A.transpose().lazyProduct(y);
  }

  // Half the gradient of |W e|^2 at v + shift along joint i; downhill is positive.
  Vector SlopeBeside(int i, double shift) const {
    Place beside;
    beside.v = now_.v;
    beside.v(i) += shift * unit_(i);
    Evaluate(&beside);
    return beside.A.transpose().lazyProduct(beside.weighted);
  }

  // Newton with the whole second derivative, by differences of the exact gradient: where a
  // remainder stays, Gauss-Newton creeps along its valley.
  bool NewtonStep(Vector* step) const {
    const Eigen::Index n = now_.v.size();
    Square hessian(n, n);
    for (int i = 0; i < n; ++i) {
      if (task_.held[i])
        hessian.col(i) = Vector::Unit(n, i);
      else
        hessian.col(i) = (SlopeBeside(i, -kBeside) - SlopeBeside(i, kBeside)) / (2 * kBeside);
    }
    const Square symmetric = 0.5 * (hessian + hessian.transpose());
    const Eigen::LLT<Square> llt(symmetric);
    if (llt.info() != Eigen::Success) return false;
    *step = llt.solve(Vector(now_.A.transpose().lazyProduct(now_.weighted)));
    return step->allFinite();
  }

  Vector StepOf(double damping, int iteration) const {
    if (FreeJoints() >= 6) return LeastChange(now_.weighted, damping);
    Vector newton;
    if (iteration > kGaussNewtons && damping == 0 && NewtonStep(&newton)) return newton;
    Square normal = now_.A.transpose().lazyProduct(now_.A);
    const double largest = normal.diagonal().maxCoeff();
    for (int i = 0; i < normal.rows(); ++i)
      normal(i, i) += task_.held[i] ? 1 : (damping + kRegular) * largest;
    const Vector b = now_.A.transpose().lazyProduct(now_.weighted);
    return normal.ldlt().solve(b);
  }

  Vector TowardsStep(const Vector& reference) const {
    Vector away = (now_.v - reference).cwiseQuotient(unit_);
    for (int i = 0; i < away.size(); ++i) {
      if (task_.held[i]) away(i) = 0;
    }
    const Twist along = now_.A.lazyProduct(away);
    return LeastChange(now_.weighted + along, 0) - away;
  }

  // Prismatic joints go as far as they are sent: along them the pose is linear.
  double ShareOf(const Vector& step) const {
    double largest = 0;
    for (int i = 0; i < step.size(); ++i)
      largest = std::max(largest, task_.chain->prismatic[i] ? 0 : std::abs(step(i)));
    return largest > kLongestStep ? kLongestStep / largest : 1;
  }

  Vector Limited(const Vector& step) const { return step * ShareOf(step); }
  static bool IsNothing(const Vector& step) { return !(step.cwiseAbs().maxCoeff() > kNothing); }
  // Of draws, whose last digits are those of a solution by normal equations.
  static bool IsSettled(const Vector& step) { return step.cwiseAbs().maxCoeff() < 1e-10; }

  // Takes the step when it lowers the remainder, or leaves it within rounding: near a remainder
  // that stays, steps contract long after its square has no more digits to say so.
  bool Try(const Vector& step) {
    Place next;
    next.v = now_.v + step.cwiseProduct(unit_);
    Evaluate(&next);
    if (!(next.weighted.squaredNorm() <= now_.weighted.squaredNorm() * (1 + kRounding)))
      return false;
    now_ = next;
    return true;
  }

  static double Eased(double damping) { return damping > kLeastDamping ? damping / 10 : 0; }

  void Fill(LeastSquaresResult* result) const {
    std::copy_n(now_.v.data(), now_.v.size(), result->v.data());
    result->cost = now_.weighted.norm();
    result->position_error_m = now_.e.head<3>().norm();
    result->rotation_error_rad = now_.e.tail<3>().norm();
  }

  const LeastSquaresTask& task_;
  Vector unit_;
  Place now_;
};

}  // namespace

LeastSquaresResult SolveLeastSquares(const LeastSquaresTask& task, const double* start) noexcept {
  return Solver(task, start).Solve();
}

LeastSquaresResult DrawTowards(const LeastSquaresTask& task, const double* reference,
                               const LeastSquaresResult& result) noexcept {
  return Solver(task, result.v.data()).Draw(reference, result);
}

}  // namespace truepose::compensation
