#include "core/identification/identifiability.h"

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

namespace truepose {
namespace {

std::vector<int> InOrderOfPreference(const ParameterSet& candidates) {
  std::vector<int> order(candidates.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return candidates[a].role < candidates[b].role; });
  return order;
}

// A triangle with the same column geometry as J: the greedy basis then costs nothing however many
// readings there are.
Eigen::MatrixXd TriangleOf(const Eigen::MatrixXd& J) {
  if (J.rows() <= J.cols()) return J;
  return Eigen::HouseholderQR<Eigen::MatrixXd>(J)
      .matrixQR()
      .topRows(J.cols())
      .triangularView<Eigen::Upper>();
}

// Grows an orthonormal basis of the kept columns.
class GreedyBasis {
 public:
  GreedyBasis(const Eigen::MatrixXd& columns, int most)
      : columns_(columns), Q_(columns.rows(), most) {}

  // The part of a column that the kept ones don't explain; projected twice, since once leaves
  // rounding behind.
  Eigen::VectorXd Unexplained(int column) const {
    Eigen::VectorXd v = columns_.col(column);
    for (int pass = 0; pass < 2; ++pass) v -= Basis() * (Basis().transpose() * v);
    return v;
  }

  void Keep(int column, const Eigen::VectorXd& unexplained) {
    Q_.col(static_cast<Eigen::Index>(kept_.size())) = unexplained.normalized();
    kept_.push_back(column);
  }

  // Coefficients c of the kept columns with column = sum c_k kept_k.
  Eigen::VectorXd Coefficients(int column) const {
    if (kept_.empty()) return {};
    const Eigen::MatrixXd R = Basis().transpose() * columns_(Eigen::all, kept_);
    return R.triangularView<Eigen::Upper>().solve(Basis().transpose() * columns_.col(column));
  }

  const std::vector<int>& kept() const { return kept_; }

 private:
  Eigen::MatrixXd::ConstColsBlockXpr Basis() const {
    return Q_.leftCols(static_cast<Eigen::Index>(kept_.size()));
  }

  const Eigen::MatrixXd& columns_;
  Eigen::MatrixXd Q_;
  std::vector<int> kept_;
};

// Terms below this share of the dropped column are rounding.
constexpr double kNegligibleTerm = 1e-6;

NullRelation RelationOf(const Eigen::MatrixXd& columns, const GreedyBasis& basis, int column) {
  NullRelation relation;
  relation.dropped = column;
  const double norm = columns.col(column).norm();
  if (norm == 0) return relation;
  const Eigen::VectorXd c = basis.Coefficients(column);
  for (Eigen::Index k = 0; k < c.size(); ++k) {
    const int kept = basis.kept()[static_cast<size_t>(k)];
    if (std::abs(c(k)) * columns.col(kept).norm() > kNegligibleTerm * norm)
      relation.kept.emplace_back(kept, c(k));
  }
  return relation;
}

bool IsUndetermined(const Parameter& parameter, double unexplained,
                    const IdentifiabilityOptions& options) {
  const bool bounded =
      parameter.role != ParameterRole::kExternal && parameter.role != ParameterRole::kEffect;
  if (!options.use_sd_bounds || !bounded) return false;
  return 1 / unexplained >
         (parameter.is_angle() ? options.most_angle_sd_rad : options.most_length_sd_m);
}

double ScaledCondition(const Eigen::MatrixXd& columns, const std::vector<int>& kept) {
  if (kept.empty()) return 1;
  Eigen::MatrixXd scaled = columns(Eigen::all, kept);
  scaled.colwise().normalize();
  const Eigen::VectorXd s = Eigen::JacobiSVD<Eigen::MatrixXd>(scaled).singularValues();
  return s(0) / s(s.size() - 1);
}

}  // namespace

IdentifiableSet Identifiable(const Eigen::MatrixXd& J, const ParameterSet& candidates,
                             const IdentifiabilityOptions& options) {
  const Eigen::MatrixXd columns = TriangleOf(J);
  // A column of the gauge is zero but for rounding, and would look independent once scaled: compare
  // with the largest.
  const double zero = 1e-13 * columns.colwise().norm().maxCoeff();
  GreedyBasis basis(columns, static_cast<int>(std::min(columns.rows(), columns.cols())));
  IdentifiableSet set;
  for (int column : InOrderOfPreference(candidates)) {
    const double norm = columns.col(column).norm();
    const Eigen::VectorXd unexplained = basis.Unexplained(column);
    if (norm <= zero || unexplained.norm() <= options.dependent_below * norm) {
      set.redundancies.push_back(norm <= zero ? NullRelation{column, {}, false, false}
                                              : RelationOf(columns, basis, column));
    } else if (IsUndetermined(candidates[column], unexplained.norm(), options)) {
      set.redundancies.push_back({column, {}, true, false});
    } else {
      basis.Keep(column, unexplained);
    }
  }
  set.active = basis.kept();
  std::sort(set.active.begin(), set.active.end());
  set.condition = ScaledCondition(columns, set.active);
  return set;
}

}  // namespace truepose
