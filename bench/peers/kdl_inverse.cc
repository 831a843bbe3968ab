#include "bench/peers/kdl_inverse.h"

#include <kdl/chain.hpp>
#include <kdl/chainiksolverpos_lma.hpp>

namespace truepose::bench {
namespace {

KDL::Frame FrameOf(const Pose& X) {
  const auto& R = X.R;
  return KDL::Frame(KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0),
                                  R(2, 1), R(2, 2)),
                    KDL::Vector(X.p.x(), X.p.y(), X.p.z()));
}

KDL::Chain ChainOf(const compensation::JointChain& chain) {
  KDL::Chain segments;
  segments.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), FrameOf(chain.constant[0])));
  for (int i = 0; i < chain.joints; ++i)
    segments.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), FrameOf(chain.constant[i + 1])));
  return segments;
}

}  // namespace

struct KdlInverse::Solver {
  explicit Solver(const compensation::JointChain& joints)
      // 1e-9: as exact as ours; lengths in m and angles in rad count alike.
      : chain(ChainOf(joints)),
        solver(chain, Eigen::Matrix<double, 6, 1>::Ones(), 1e-9),
        start(static_cast<unsigned>(joints.joints)),
        end(static_cast<unsigned>(joints.joints)) {}

  KDL::Chain chain;
  KDL::ChainIkSolverPos_LMA solver;
  KDL::JntArray start, end;
};

KdlInverse::KdlInverse(const compensation::JointChain& chain)
    : solver_(std::make_unique<Solver>(chain)) {}

KdlInverse::~KdlInverse() = default;

bool KdlInverse::Solve(const Pose& X_BF, const double* q_start, double* q) {
  for (unsigned i = 0; i < solver_->start.rows(); ++i) solver_->start(i) = q_start[i];
  const int code = solver_->solver.CartToJnt(solver_->start, FrameOf(X_BF), solver_->end);
  for (unsigned i = 0; i < solver_->end.rows(); ++i) q[i] = solver_->end(i);
  return code >= 0;
}

}  // namespace truepose::bench
