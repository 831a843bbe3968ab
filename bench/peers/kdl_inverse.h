// The peer: inverse kinematics of Orocos KDL (Levenberg-Marquardt), which a robot programmer would
// call with the identified chain.
#pragma once

#include <array>
#include <memory>

#include "compensation/arm.h"

namespace truepose::bench {

// Of an arm of revolute joints; one per thread.
class KdlInverse {
 public:
  explicit KdlInverse(const compensation::JointChain& chain);
  ~KdlInverse();

  // @returns false when it does not arrive. @param q joints, six.
  bool Solve(const Pose& X_BF, const double* q_start, double* q);

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace truepose::bench
