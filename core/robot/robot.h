// A robot as its controller believes it to be: joints, their limits, and the nominal chain from
// base B to flange F.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/chain/chain.h"
#include "core/robot/gravity.h"

namespace truepose {

enum class JointType { kRevolute, kPrismatic };

// One controller joint. Limits are of the controller's reading, rad or m; infinite where none is
// known.
struct Joint {
  std::string name;
  JointType type = JointType::kRevolute;
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

// q_chain = scale * q_controller + offset. Signs and couplings such as J3 = J2 + J3 live here.
struct JointMap {
  Eigen::MatrixXd scale;   // n x n, invertible
  Eigen::VectorXd offset;  // n; rad or m

  static JointMap Identity(int joints);
  Eigen::VectorXd ToChain(const Eigen::VectorXd& q_controller) const {
    return scale * q_controller + offset;
  }
  Eigen::VectorXd ToController(const Eigen::VectorXd& q_chain) const;
};

// Frozen by Create.
class Robot {
 public:
  // @param chain nominal elements from B to F, without parameters, each joint 0..n-1 in exactly one
  // element and in
  //   ascending order; a revolute joint moves a rotation, a prismatic one a translation.
  // @returns kInvalidArgument with every fault: a joint count that does not match, a joint that is
  // missing, repeated
  //   or of the wrong kind, a map of the wrong size or not invertible, values that are not finite,
  //   limits in the wrong order, two consecutive prismatic joints that are parallel (they are one
  //   joint twice, chapter-notes 7).
  static absl::StatusOr<Robot> Create(std::vector<Joint> joints, Chain chain, JointMap map,
                                      std::vector<LinkMass> masses = {});

  int joint_count() const { return static_cast<int>(joints_.size()); }
  const std::vector<Joint>& joints() const { return joints_; }
  const Chain& chain() const { return chain_; }
  const JointMap& joint_map() const { return map_; }
  // Empty where they are not known.
  const std::vector<LinkMass>& masses() const { return masses_; }
  // The middle of the joint's limits; where one is missing the value nearest to 0. Controller
  // joints.
  Eigen::VectorXd MiddleOfLimits() const;

 private:
  Robot(std::vector<Joint> joints, Chain chain, JointMap map, std::vector<LinkMass> masses);

  std::vector<Joint> joints_;
  Chain chain_;
  JointMap map_;
  std::vector<LinkMass> masses_;
};

// X_BF at controller joints q, nominal geometry.
Pose NominalForward(const Robot& robot, const Eigen::VectorXd& q_controller);

}  // namespace truepose
