// Least squares of the check readings with some parts free: minimises over z and y
//   |W r(A z + y, q + M dq)|^2 + |z|^2
// C = A A'; y: changes of free candidates and of joints; W: error_field.h; M: the joint map, so dq
// are offsets of controller joints. Gauss-Newton with step halving; big changes (degrees) take a
// few iterations, small ones are linear.
#pragma once

#include "core/drift/drift_problem.h"
#include "core/drift/error_field.h"
#include "core/identification/prediction.h"

namespace truepose {

// What may differ from the calibration beside its covariance.
struct Freedom {
  std::vector<int> candidates;  // of the check's problem
  std::vector<int> joints;      // controller joints
};

Freedom operator+(const Freedom& a, const Freedom& b);

struct DriftFit {
  double chi_square = 0;     // the minimum
  int rank = 0;              // independent directions of the freedom
  Eigen::VectorXd values;    // of all candidates about the start: A z + y
  Eigen::VectorXd changes;   // y of the freedom: candidates, then joints
  Eigen::VectorXd joints;    // dq of all controller joints
  Eigen::VectorXd whitened;  // W r
};

class DriftFitter {
 public:
  // Keeps references. @param start frames and lambda about which values count.
  DriftFitter(const DriftProblem& problem, const Estimate& start);

  // @param with_covariance false: the calibration is taken for exact, z = 0.
  DriftFit Fit(const Freedom& freedom, bool with_covariance = true) const;
  int rows() const { return rows_; }

 private:
  struct Point {
    Eigen::VectorXd z, y;
  };
  struct System {
    Eigen::VectorXd r;  // whitened, then z
    Eigen::MatrixXd J;  // by z, then y
  };

  Eigen::VectorXd Values(const Freedom& freedom, const Point& point) const;
  Eigen::VectorXd Joints(const Freedom& freedom, const Point& point) const;
  Reading Moved(const Reading& reading, const Eigen::VectorXd& joints) const;
  Eigen::VectorXd Residuals(const Freedom& freedom, const Point& point) const;
  double Cost(const Freedom& freedom, const Point& point) const;
  System Linearise(const Freedom& freedom, const Point& point) const;

  const DriftProblem& problem_;
  const Estimate start_;
  const Eigen::VectorXd start_values_;
  const FieldWhitener whitener_;
  const Eigen::MatrixXd root_;  // A
  int rows_ = 0;
};

}  // namespace truepose
