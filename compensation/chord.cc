#include "compensation/chord.h"

#include <algorithm>
#include <cmath>

#include "compensation/inverse6.h"
#include "compensation/sines.h"

namespace truepose::compensation {
namespace {

constexpr int kMostSteps = 8;
constexpr double kGoodContraction = 0.1;

bool IsIdentity(const Arm& arm) {
  double sum = 0;
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 6; ++i) sum += std::abs(arm.joint_scale(i, j) - (i == j ? 1 : 0));
  }
  return sum == 0;
}

// Beyond, a step is lost in the last digits of `v`, but not in the motions.
bool HasDigits(const JointArray& v) {
  bool has = true;
  for (int i = 0; i < 6; ++i) has &= std::abs(v[i]) <= kLargestAngle;
  return has;
}

double SizeOf(const Twist& e, double length) {
  return e.head<3>().cwiseAbs().maxCoeff() / length + e.tail<3>().cwiseAbs().maxCoeff();
}

bool Arrived(const Twist& e, const ChordOptions& options) {
  return e.head<3>().squaredNorm() <= options.position_tolerance_m * options.position_tolerance_m &&
         e.tail<3>().squaredNorm() <=
             options.rotation_tolerance_rad * options.rotation_tolerance_rad;
}

class Chords {
 public:
  Chords(const Arm& arm, const Pose& desired, const ChordOptions& options, ChordState* state)
      : arm_(arm),
        desired_(desired),
        options_(options),
        state_(*state),
        identity_(IsIdentity(arm)) {}

  bool Solve() {
    RunSweep(arm_.identified, state_.motions, &sweep_);
    state_.remainder = Remainder(desired_, sweep_.X_BF);
    if (Arrived(state_.remainder, options_)) return true;
    if (!HasDigits(state_.v)) return false;
    size_ = SizeOf(state_.remainder, options_.characteristic_length_m);
    way_left_ = options_.largest_gain * size_;
    if (!Invert() || !Step(true)) return false;
    for (state_.iterations = 1; state_.iterations <= kMostSteps; ++state_.iterations) {
      const double before = size_;
      state_.remainder = Remainder(desired_, Forward(arm_.identified, state_.motions));
      if (Arrived(state_.remainder, options_)) return true;
      size_ = SizeOf(state_.remainder, options_.characteristic_length_m);
      const bool fresh = size_ > kGoodContraction * before;
      if ((fresh && !Refresh()) || !Step(fresh)) return false;
    }
    return false;
  }

 private:
  bool Refresh() {
    RunSweep(arm_.identified, state_.motions, &sweep_);
    return Invert();
  }

  bool Invert() {
    Eigen::Matrix<double, 6, 6> J;
    for (int i = 0; i < 6; ++i) J.col(i) = ColumnOf(arm_.identified, sweep_, i);
    if (!identity_) J = (J * arm_.joint_scale.topLeftCorner<6, 6>()).eval();
    return inverse_.Set(J);
  }

  // Of a fresh Jacobian with the curvature at its place: third order for the price of half a step.
  bool Step(bool fresh) {
    double step[6], chain_step[6];
    inverse_.Solve(state_.remainder, step);
    ToChainStep(step, chain_step);
    if (fresh) {
      double bend[6];
      inverse_.Solve(Curvature(arm_.identified, sweep_, chain_step), bend);
      for (int i = 0; i < 6; ++i) step[i] -= bend[i];
      ToChainStep(step, chain_step);
    }
    return Advance(step, chain_step);
  }

  void ToChainStep(const double* step, double* chain_step) const {
    std::copy_n(step, 6, chain_step);
    if (identity_) return;
    for (int i = 0; i < 6; ++i) {
      chain_step[i] = 0;
      for (int j = 0; j < 6; ++j) chain_step[i] += arm_.joint_scale(i, j) * step[j];
    }
  }

  // @returns false when the step is too long for the small angles, or all of them for what they are
  // to undo.
  bool Advance(const double* step, const double* chain_step) {
    double largest = 0, largest_of_chain = 0;
    for (int i = 0; i < 6; ++i) {
      state_.v[i] += step[i];
      const double unit = arm_.nominal.prismatic[i] ? options_.characteristic_length_m : 1;
      largest = std::max(largest, std::abs(step[i]) / unit);
      largest_of_chain = std::max(largest_of_chain, std::abs(chain_step[i]));
    }
    way_left_ -= largest;
    if (!(way_left_ >= 0 && largest_of_chain <= kLongestSmallStep)) return false;
    AddSmallStep(arm_.identified, chain_step, &state_.motions);
    return true;
  }

  const Arm& arm_;
  const Pose& desired_;
  const ChordOptions& options_;
  ChordState& state_;
  const bool identity_;
  Sweep sweep_;
  Inverse6 inverse_;
  double size_ = 0;      // of the last remainder
  double way_left_ = 0;  // rad or lengths
};

}  // namespace

bool SolveByChords(const Arm& arm, const Pose& desired, const ChordOptions& options,
                   ChordState* state) noexcept {
  return Chords(arm, desired, options, state).Solve();
}

}  // namespace truepose::compensation
