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
  kComplete,  // with B_0 before joint 1 and C after joint n (of extended_dh A_0 and all of A_n), as
              // in Table 3
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
  std::string kind;  // one of ModelKinds()
  std::string
      convention;  // tag that gives the parameter values their meaning; stored with every set
  Chain chain;     // from B to F; its parameters are the geometric ones of `parameters`, but tilts
  ParameterSet parameters;  // all candidates, geometric first; which are identifiable depends on
                            // the readings
  std::vector<Tilt> tilts;  // of zhuang_roth
  std::vector<JointEffect> effects;
  JointMap joint_map;  // of the robot; effects act on controller joints
  // For compliance where torques were not measured: the nominal chain and its masses.
  Chain nominal_chain;
  std::vector<LinkMass> masses;
};

// X_BF(q, lambda). @param q chain joints as read. @param lambda the model's parameters.
Pose Forward(const Model& model, const Eigen::VectorXd& q, const Eigen::VectorXd& lambda,
             const Conditions& conditions = {});

// What the effects add to the chain joints q as read.
Eigen::VectorXd EffectShift(const Model& model, const Eigen::VectorXd& q,
                            const Eigen::VectorXd& lambda, const Conditions& conditions);

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

// The four models of any chain of R and P joints, all candidates; BuildModel (build_model.h) finds
// them by name. Their chains at zero parameters equal the robot's. The chain's joints are chain
// joints (after the joint map). Redundant candidates are not removed here: which partner of a
// redundancy stays is decided by Identifiable(), for generic or for actual poses. Values of one
// model mean nothing in another: ConvertCalibration (core/conversion) carries them over.

// Eq. 24 with the B_i and C of Eq. 22 and D_i = R(z, dq_i) or T(z, dq_i) (Eq. 25):
//   M = A_0 B_0 D_1 A_1 B_1 D_2 A_2 ... D_n A_n C
//   B_i = R(x, dalpha_i) R(y, dbeta_i) [T(x, da_i) T(y, db_i)], rotations first, the lengths only
//   when joint i+1, whose axis B_i places, is revolute (incremental_form.h).
Model ModifiedIncremental(const Robot& robot, ModelExtent extent);

// Eqs. 21 and 22: the same without D_i. An offset of joint i stands in B_i, B_{i+1} or C.
Model Incremental(const Robot& robot, ModelExtent extent);

// Eq. 23 takes the place of B_i in Eq. 21; there is no D_i either. B_i = T(x, da_i) T(y, db_i) R
// with R the rotation of a Tilt(dthetax_i, dthetay_i): z_i is (dthetax_i, dthetay_i, .), to first
// order dthetax = dbeta, dthetay = -dalpha of Eq. 22. Before a prismatic joint da_i = db_i = 0.
Model ZhuangRoth(const Robot& robot, ModelExtent extent);

// Eqs. 14 to 20: M = A_0 A_1 ... A_n by the rules of D&H, Hayati and PR between the axes of the
// nominal joints, whatever chain the robot is given by; the form of Eq. 33 where axes coincide
// (dh_link.h). Parameters of link i: dq_i, the error of the joint's coordinate (theta_i, h_i or l_i
// of a D&H, revolute or PR link), and dtheta_i, dh_i, dl_i, dphi_i, dbeta_i, da_i, db_i, dalpha_i
// of what else its form has. kComplete: link 0 from B to the axis of joint 1, with the forms of a
// revolute joint that stands still, and all six of the last link, dq_n dbeta_n dalpha_n dc_n db_n
// da_n (R6) or dq_n db_n da_n dgamma_n dbeta_n dalpha_n (P6), Eq. 19. kInternal: neither, but dq_n.
Model ExtendedDh(const Robot& robot, ModelExtent extent);

}  // namespace truepose
