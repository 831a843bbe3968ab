#include "core/identification/nelder_mead.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace truepose {
namespace {

struct Vertex {
  Eigen::VectorXd point;
  double value = 0;
};

bool Better(const Vertex& a, const Vertex& b) { return a.value < b.value; }

class Simplex {
 public:
  Simplex(const std::function<double(const Eigen::VectorXd&)>& function,
          const Eigen::VectorXd& start, double step)
      : function_(function), n_(static_cast<int>(start.size())) {
    vertices_.push_back(At(start));
    for (int i = 0; i < n_; ++i)
      vertices_.push_back(At(start + step * Eigen::VectorXd::Unit(n_, i)));
    std::sort(vertices_.begin(), vertices_.end(), Better);
  }

  void Step() {
    const Eigen::VectorXd centre = CentreOfBest();
    const Vertex reflected = Along(centre, 1);
    if (Better(reflected, best())) return Replace(Improved(reflected, Along(centre, expansion_)));
    if (Better(reflected, vertices_[n_ - 1])) return Replace(reflected);
    const bool outside = Better(reflected, worst());
    const Vertex contracted = Along(centre, outside ? contraction_ : -contraction_);
    if (Better(contracted, outside ? reflected : worst())) return Replace(contracted);
    Shrink();
  }

  const Vertex& best() const { return vertices_.front(); }
  const Vertex& worst() const { return vertices_.back(); }
  int evaluations() const { return evaluations_; }

 private:
  Vertex At(const Eigen::VectorXd& point) {
    ++evaluations_;
    const double value = function_(point);
    return {point, std::isfinite(value) ? value : std::numeric_limits<double>::infinity()};
  }

  // From the worst vertex through the centre of the others and on by `factor`.
  Vertex Along(const Eigen::VectorXd& centre, double factor) {
    return At(centre + factor * (centre - worst().point));
  }

  static const Vertex& Improved(const Vertex& a, const Vertex& b) { return Better(b, a) ? b : a; }

  Eigen::VectorXd CentreOfBest() const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n_);
    for (int i = 0; i < n_; ++i) sum += vertices_[i].point;
    return sum / n_;
  }

  void Replace(const Vertex& vertex) {
    vertices_.pop_back();
    vertices_.insert(std::upper_bound(vertices_.begin(), vertices_.end(), vertex, Better), vertex);
  }

  void Shrink() {
    const Eigen::VectorXd to = best().point;
    for (int i = 1; i <= n_; ++i) vertices_[i] = At(to + shrinkage_ * (vertices_[i].point - to));
    std::sort(vertices_.begin(), vertices_.end(), Better);
  }

  const std::function<double(const Eigen::VectorXd&)>& function_;
  const int n_;
  // In one dimension the formulas would make the simplex a point.
  const double dimension_ = std::max(n_, 2);
  const double expansion_ = 1 + 2 / dimension_, contraction_ = 0.75 - 0.5 / dimension_,
               shrinkage_ = 1 - 1 / dimension_;
  std::vector<Vertex> vertices_;  // best first
  int evaluations_ = 0;
};

}  // namespace

NelderMeadResult NelderMead(const std::function<double(const Eigen::VectorXd&)>& function,
                            const Eigen::VectorXd& start, const NelderMeadOptions& options,
                            const std::function<bool()>& stop) {
  Simplex simplex(function, start, options.step);
  bool converged = false;
  const auto fits = [&] {  // a step may take a reflection, a contraction and n of a shrinkage
    return simplex.evaluations() + start.size() + 2 <= options.max_evaluations;
  };
  while (!converged && fits() && !stop()) {
    simplex.Step();
    converged = simplex.worst().value - simplex.best().value <= options.value_tolerance;
  }
  return {simplex.best().point, simplex.best().value, simplex.evaluations(), converged};
}

}  // namespace truepose
