// Table 2: columns of the identification Jacobian of two links of a robot with three revolute
// joints (Fig. 7, Eq. 32), in frame i-1, and what they depend on.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace truepose {

struct Table2Arguments {
  double q = 0, q_next = 0;  // of joints i and i+1, rad
  double l = 0, l_next = 0;  // link lengths, m
};

struct Table2Result {
  // "da_{i-1}" ... "dq_{i+2}": j1 ... j15.
  std::vector<std::string> names;
  Eigen::Matrix<double, 6, Eigen::Dynamic> J;  // rows dx dy dz dalpha dbeta dgamma, m and rad
  // The columns as the chapter means them, C, S of q and C', S' of q_next; what the scan has lost
  // is put back. "..." for j13 to j15.
  std::vector<std::string> printed;
  // j5 - j9 - l j12, zero: one of dq_i, dbeta_i, db_{i+1} is redundant. With l = 0 db_{i+1} takes
  // no part in it, and dropping it would leave the model redundant and incomplete.
  Eigen::Matrix<double, 6, 1> null_relation;
};

Table2Result Table2(const Table2Arguments& arguments);

}  // namespace truepose
