#include "compensation/path.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "compensation/singularity.h"
#include "compensation/valid.h"

namespace truepose::compensation {
namespace {

constexpr double kLongestPiece = 0.2;
constexpr double kShortestShare = 1.0 / 1024;

Pose Between(const Pose& a, const Pose& b, double share) {
  const Eigen::Vector3d turn = LogRotation<double>(a.R.transpose() * b.R);
  return {a.R * ExpRotation<double>(share * turn), a.p + share * (b.p - a.p)};
}

// How the arm stands: distance to a singularity and, of six joints, on which side of it.
struct Stand {
  double singular_value = 0;
  bool positive = true;
};

class Follower {
 public:
  Follower(const Arm& arm, const InverseOptions& options, const JointArray& q, PathEnd* end)
      : arm_(arm), options_(options), n_(arm.nominal.joints), q_(q), end_(*end) {
    task_ = TaskOf(arm, arm.nominal, Pose{}, options);
    stand_ = StandAt(q);
    end_.smallest_singular_value = stand_.singular_value;
  }

  // @returns false with `end` filled where the way ends before b.
  bool Go(const Pose& a, const Pose& b) {
    double share = 0, piece = 1;
    while (share < 1) {
      piece = std::min(piece, 1 - share);
      const Outcome outcome = TryPiece(Between(a, b, share + piece));
      if (outcome == Outcome::kOk) {
        share += piece;
        piece *= 2;
        continue;
      }
      piece /= 2;
      if (piece >= kShortestShare) continue;
      end_.outcome = outcome;
      end_.share = share;
      return false;
    }
    return true;
  }

  const JointArray& q() const { return q_; }

 private:
  Stand StandAt(const JointArray& q) const {
    JointArray q_chain;
    ToChain(arm_, q.data(), q_chain.data());
    Motions motions;
    SetMotions(arm_.nominal, q_chain.data(), &motions);
    Sweep sweep;
    RunSweep(arm_.nominal, motions, &sweep);
    Stand stand;
    stand.singular_value = SmallestSingularValue(arm_.nominal, sweep, task_.length_m);
    if (n_ == 6) {
      const Eigen::Matrix<double, 6, 6> J = JacobianOf(arm_.nominal, sweep);
      stand.positive = J.determinant() > 0;
    }
    return stand;
  }

  bool IsThere(const LeastSquaresResult& found) const {
    if (n_ >= 6) return found.reached;
    return found.settled && found.position_error_m <= options_.largest_position_miss_m;
  }

  double LargestMove(const JointArray& q) const {
    double largest = 0;
    for (int i = 0; i < n_; ++i) {
      const double unit = arm_.nominal.prismatic[i] ? task_.length_m : 1;
      largest = std::max(largest, std::abs(q[i] - q_[i]) / unit);
    }
    return largest;
  }

  Outcome TryPiece(const Pose& X) {
    task_.desired = X;
    const LeastSquaresResult found = SolveLeastSquares(task_, q_.data());
    if (!IsThere(found)) return Outcome::kUnreachable;
    if (LargestMove(found.v) > kLongestPiece) return Outcome::kNearSingular;
    end_.joint = BeyondLimit(arm_, found.v.data());
    if (end_.joint >= 0) return Outcome::kBeyondLimit;
    const Stand stand = StandAt(found.v);
    end_.smallest_singular_value = std::min(end_.smallest_singular_value, stand.singular_value);
    if (stand.singular_value < options_.singular_threshold || stand.positive != stand_.positive)
      return Outcome::kNearSingular;
    q_ = found.v;
    stand_ = stand;
    return Outcome::kOk;
  }

  const Arm& arm_;
  const InverseOptions& options_;
  const int n_;
  JointArray q_;
  PathEnd& end_;
  LeastSquaresTask task_;
  Stand stand_;
};

}  // namespace

PathEnd FollowPath(const Arm& arm, const Pose* X_BF, int count, const double* q_start,
                   const InverseOptions& options, JointArray* q) noexcept {
  PathEnd end;
  if (count < 1 || !std::all_of(X_BF, X_BF + count, IsPose)) return end;
  const Correction first = NearestBranch(arm, X_BF[0], q_start, options);
  end.outcome = first.outcome;
  end.joint = first.joint;
  if (first.outcome != Outcome::kOk) return end;
  q[0] = first.q;
  Follower follower(arm, options, first.q, &end);
  for (end.followed = 1; end.followed < count; ++end.followed) {
    const int next = end.followed;
    if (!follower.Go(X_BF[next - 1], X_BF[next])) {
      const Branches other = AllBranches(arm, X_BF[next], follower.q().data(), options);
      end.needs_other_branch = other.outcome == Outcome::kOk;
      return end;
    }
    q[next] = follower.q();
  }
  return end;
}

}  // namespace truepose::compensation
