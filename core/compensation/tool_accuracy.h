// How far a compensated tool is predicted to be off in B.
//
// At chain joints q the position error of the tool point T is taken as normal with the covariance
//   S = J C J' + s^2 I + s_r^2 (|d|^2 I - d d') + s_q^2 I
// J: T's position in B by the identified internal parameters, C their covariance; s, s_r: what the
// calibration left unexplained, per axis, position at the calibrated target and rotation, which a
// tool at the distance d from that target turns into position; s_q: repeatability per axis. What is
// unexplained holds the scatter of one visit already, so S is on the safe side by s_q^2 I.
//
// Base and tool of the calibration have no part in it: compensation acts from B to F.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/compensation/table_axes.h"
#include "core/models/model.h"

namespace truepose {

struct AccuracySources {
  const Model* model = nullptr;
  Eigen::VectorXd lambda;
  std::vector<int> active;                        // internal parameters with an uncertainty
  Eigen::MatrixXd covariance;                     // of these, SI
  double unexplained_m = 0, unexplained_rad = 0;  // per axis
  Eigen::Vector3d p_F_target = Eigen::Vector3d::Zero();
  double repeatability_m = 0;  // per axis
};

struct ToolAccuracy {
  Eigen::Matrix3d covariance;  // S, m^2
  // Roots of the traces: of S, and of its parts.
  double rms_m = 0, parameters_m = 0, unexplained_m = 0, repeatability_m = 0;
  double position_95_m = 0;  // 95 % of errors are shorter
};

// @param q_chain as read. @param p_F_tool T in F.
ToolAccuracy AccuracyAt(const AccuracySources& sources, const JointVector& q_chain,
                        const Eigen::Vector3d& p_F_tool);

// r with P(|e| <= r) = 95 % for e normal with the covariance S: by chi-square of the mean and
// variance of |e|^2 (Satterthwaite) and its quantile by Wilson and Hilferty; right to 2 %.
double Radius95(const Eigen::Matrix3d& S);

// s_q of a pose repeatability RP of ISO 9283 = l-bar + 3 S_l: for a normal scatter s_q in three
// axes l-bar = sqrt(8 / pi) s_q and S_l = sqrt(3 - 8 / pi) s_q.
double DeviationOfRepeatability(double iso_rp_m);

// The radius within which 95 % of errors lie over poses that are met equally often.
// @param covariances S of each, not empty. By bisection of the mean probability, with the same
// approximation for each.
double Radius95(const std::vector<Eigen::Matrix3d>& covariances);

}  // namespace truepose
