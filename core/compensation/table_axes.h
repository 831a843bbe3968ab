// The coordinates u = W q of a table, and how they lie between the joints of controller and chain.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "compensation/arm.h"
#include "compensation/table.h"

namespace truepose {

// Values of joints or of coordinates u, without allocation.
using JointVector =
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, compensation::kMaxJoints, 1>;
using JointMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                  compensation::kMaxJoints, compensation::kMaxJoints>;

struct AxisRange {
  double lower = 0, upper = 0;
  double width() const { return upper - lower; }
};

// q_chain = S q_controller + offset, u = W q_chain.
class TableAxes {
 public:
  // @param weight W, n x n, integers with determinant +-1.
  TableAxes(const compensation::Arm& arm, JointMatrix weight);

  int joints() const { return static_cast<int>(weight_.rows()); }
  const JointMatrix& weight() const { return weight_; }
  JointVector FromChain(const JointVector& q_chain) const { return weight_ * q_chain; }
  JointVector FromController(const JointVector& q) const { return to_u_ * q + at_zero_; }
  JointVector ToController(const JointVector& u) const { return from_u_ * (u - at_zero_); }
  // The smallest and largest u_k of controller joints within `ranges`, which may be infinite.
  AxisRange Hull(int k, const std::vector<compensation::JointLimits>& ranges) const;
  // Whether u_k is a length: only prismatic joints take part in it.
  bool IsLength(int k) const;

 private:
  JointMatrix weight_, to_u_, from_u_;
  JointVector at_zero_;
  std::array<bool, compensation::kMaxJoints> prismatic_;
};

// W that turns a box of controller joints into a box of u: S^-1 where that is of integers with
// determinant +-1 (signs, couplings such as J3 = J2 + J3), else the identity, whose box is wider.
JointMatrix WeightOfControllerJoints(const compensation::Arm& arm);

// W for chain joints that take the values of `samples` together: a turning joint whose nominal axis
// is parallel to those of the turning joints before it (with at most sliding ones between, which
// turn nothing) may be replaced by its signed sum with some of them, the last ones first, where
// that sum has the narrower range. So a cone of orientations becomes a narrow range: of a UR10 q2,
// q3, q2 + q3 + q4, q5.
JointMatrix WeightOfSamples(const compensation::Arm& arm, const std::vector<JointVector>& samples);

}  // namespace truepose
