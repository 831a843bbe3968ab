// A model of a robot's geometric errors: a chain with parameters, and their names. Frozen once
// built.
#pragma once

#include <string>
#include <vector>

#include "core/chain/chain.h"
#include "core/models/effects.h"
#include "core/parameters/parameter_set.h"
#include "core/robot/conditions.h"
#include "core/robot/robot.h"

namespace truepose {

// Which of the chapter's error frames a model has beside the internal ones.
enum class ModelExtent {
  kInternal,  // from B to F; base and tool are frames of the measurement (identification/problem.h)
  kComplete,  // with B_0 before joint 1 and C after joint n, as in Table 3
};

// The rotation of Eq. 23 that carries z to (theta_x, theta_y, sqrt(1 - theta_x^2 - theta_y^2)), as
// three elements of the chain: R(x, alpha) R(y, beta) R(z, gamma) with
//   alpha = atan2(-theta_y, theta_z), beta = asin(theta_x),
//   gamma = atan2(theta_x theta_y, 1 + theta_z - theta_x^2).
// The chain's parameter `theta_x` is beta, its parameter `theta_y` alpha (to first order -theta_y),
// and `gamma` a further parameter of the chain that the model does not have.
struct Tilt {
  int theta_x, theta_y, gamma;
};

struct Model {
  std::string kind;  // "modified_incremental"
  std::string
      convention;  // tag that gives the parameter values their meaning; stored with every set
  Chain chain;     // from B to F; its parameters are the geometric ones of `parameters`, but tilts
  ParameterSet parameters;  // all candidates, geometric first; which are identifiable depends on
                            // the readings
  std::vector<Tilt> tilts;  // of zhuang_roth
  std::vector<JointEffect> effects;
  JointMap joint_map;  // of the robot; effects act on controller joints
};

// X_BF(q, lambda). @param q chain joints as read. @param lambda the model's parameters.
Pose Forward(const Model& model, const Eigen::VectorXd& q, const Eigen::VectorXd& lambda,
             const Conditions& conditions = {});

// Pose and Jacobians of one configuration; reused from call to call, one per thread. Columns are
// twists at the origin of B, as those of Sweep.
struct ModelSweep {
  Pose X_BF;
  Eigen::Matrix<double, 6, Eigen::Dynamic> J_joints;      // by chain joints as moved
  Eigen::Matrix<double, 6, Eigen::Dynamic> J_parameters;  // by lambda
  // Scratch.
  Sweep chain;
  Eigen::VectorXd q, mu;
};

// @param q chain joints as read, lambda the model's parameters.
void RunSweep(const Model& model, const double* q, const double* lambda,
              const Conditions& conditions, ModelSweep* sweep);

// The modified incremental model (Eq. 24) of any chain of R and P joints, all candidates:
//   M = A_0 B_0 D_1 A_1 B_1 D_2 A_2 ... D_n A_n C
// D_i = R(z, dq_i) or T(z, dq_i) (Eq. 25); B_i = R(x, dalpha_i) R(y, dbeta_i) [T(x, da_i) T(y,
// db_i)], the lengths only when *joint i+1*, whose axis B_i places, is revolute (Eq. 22 with
// chapter-notes 1); C = R(x) R(y) R(z) T(x) T(y) T(z). The nominal is rewritten first so that every
// A_i begins with its joint motion about or along z_{i-1} (chapter-notes 2): a joint about another
// axis u is turned by the constant rotation that carries z to u, and back behind it. The chain's
// joints are chain joints (after the joint map). Redundant candidates are not removed here: which
// partner of a redundancy stays is decided by Identifiable(), for generic or for actual poses.
Model ModifiedIncremental(const Robot& robot, ModelExtent extent);

}  // namespace truepose
