// The trap of a calibration that looks well and harms (experiments E7), and its opposite. A gear
// error 100 times a turn is noise to 8 poses: 30 parameters fit it there and carry it everywhere
// else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>

#include "core/base/random.h"
#include "core/calibrate/calibrate.h"
#include "tests/core/testing/models.h"
#include "tests/core/testing/robots.h"
#include "tests/golden/long_run.h"

namespace truepose {
namespace {

using testing::kDeg;

struct Design {
  double gear_rad;  // of sin(100 q + phi_j)
  double length_sd_m, angle_sd_rad;
  int calibration_poses;
  double calibration_range_rad;  // about home
};

constexpr int kControlPoses = 60;
const Pose kTool{Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.020, -0.030, 0.100)};

// A UR10 that stands anywhere, its gears and the instrument: draws one session.
class GearedRobot {
 public:
  GearedRobot(const Design& design, uint64_t seed)
      : design_(design),
        random_(seed),
        robot_(testing::Ur10()),
        model_(ModifiedIncremental(robot_, ModelExtent::kInternal)),
        lambda_(model_.parameters.size()) {
    for (double& phase : phase_) phase = random_.Uniform(0, 2 * std::numbers::pi);
    for (Eigen::Index i = 0; i < lambda_.size(); ++i) {
      const bool angle = model_.parameters[static_cast<int>(i)].is_angle();
      lambda_(i) = (angle ? design.angle_sd_rad : design.length_sd_m) * random_.Normal();
    }
    X_MB_.p = {random_.Uniform(-3, 3), random_.Uniform(-3, 3), random_.Uniform(-3, 3)};
    X_MB_.R = ExpRotation<double>(testing::RandomVector(3, 1.8, &random_));
  }

  CalibrationProblem Session() {
    CalibrationProblem problem;
    problem.robot = &robot_;
    problem.placements = problem.targets = {""};
    problem.X_FT_nominal = kTool;
    for (int i = 0; i < design_.calibration_poses + kControlPoses; ++i) {
      const bool calibrates = i < design_.calibration_poses;
      problem.readings.push_back(ReadingWithin(calibrates ? design_.calibration_range_rad : 1));
      problem.readings.back().id = i;
      problem.calibrates.push_back(calibrates);
    }
    return problem;
  }

 private:
  Reading ReadingWithin(double range_rad) {
    Reading reading;
    reading.q = (Eigen::VectorXd(6) << 0, -1.4, 1.8, -1.9, -1.6, 0).finished() +
                testing::RandomVector(6, range_rad, &random_);
    Eigen::VectorXd q_true = reading.q;
    for (int j = 0; j < 6; ++j)
      q_true(j) += design_.gear_rad * std::sin(100 * q_true(j) + phase_[j]);
    reading.X_MT = X_MB_ * Forward(model_, q_true, lambda_) * kTool;
    reading.X_MT.p += Noise(5e-5);
    reading.X_MT.R = ExpRotation<double>(Noise(0.01 * kDeg)) * reading.X_MT.R;
    return reading;
  }

  Eigen::Vector3d Noise(double sd) {
    Eigen::Vector3d noise;
    for (double& value : noise) value = sd * random_.Normal();
    return noise;
  }

  Design design_;
  Random random_;
  Robot robot_;
  Model model_;
  Eigen::VectorXd lambda_;
  double phase_[6];
  Pose X_MB_;
};

double Rms(const std::vector<PoseError>& errors) { return PoseStatisticsOf(errors).position_m.rms; }

std::string Reasons(const Verdict& verdict) {
  std::string all;
  for (const std::string& reason : verdict.reasons) all += reason + "; ";
  return all;
}

// In 400 of 400 seeds the control set is worse by 1.25 at least, 0.92 -> 2.45 mm on average, while
// the calibration set improves, 0.41 -> 0.24. Would catch a verdict by the calibration
// set. 100 seeds measured 0.88 -> 2.71 mm, ratios of 1.29 and more, do_not_apply in all.
TEST(DoNotApply, EightPosesAndAGear) {
  const Design trap = {0.03 * kDeg, 0, 0, 8, 0.3};
  const int sessions = testing::Draws(20, 100);
  double before = 0, after = 0, least_ratio = std::numeric_limits<double>::infinity();
  for (int seed = 1; seed <= sessions; ++seed) {
    GearedRobot robot(trap, static_cast<uint64_t>(seed));
    const auto result = Calibrate(robot.Session(), {}, {});
    ASSERT_TRUE(result.ok()) << result.status();
    EXPECT_EQ(result->verdict.decision, Decision::kDoNotApply)
        << "seed " << seed << ": " << Reasons(result->verdict);
    EXPECT_LT(Rms(result->calibration.after), Rms(result->calibration.before)) << "seed " << seed;
    before += Rms(result->control.before) / sessions;
    after += Rms(result->control.after) / sessions;
    least_ratio = std::min(least_ratio, Rms(result->control.after) / Rms(result->control.before));
  }
  std::cout << "control " << before * 1e3 << " -> " << after * 1e3 << " mm, least ratio "
            << least_ratio << "\n";
  EXPECT_GE(least_ratio, 1.25);
}

// A robot with errors of manufacture, measured well: 0.58 -> 0.19 mm on average. Would catch a
// verdict that is merely afraid. 100 seeds measured 0.65 -> 0.194 mm.
TEST(DoNotApply, NeverForSixtyPosesOfARobotWithErrors) {
  const Design sound = {0.01 * kDeg, 3e-4, 0.03 * kDeg, 60, 1};
  const int sessions = testing::Draws(20, 100);
  double before = 0, after = 0;
  for (int seed = 1; seed <= sessions; ++seed) {
    GearedRobot robot(sound, static_cast<uint64_t>(seed));
    const auto result = Calibrate(robot.Session(), {}, {});
    ASSERT_TRUE(result.ok()) << result.status();
    EXPECT_NE(result->verdict.decision, Decision::kDoNotApply)
        << "seed " << seed << ": " << Reasons(result->verdict);
    EXPECT_LT(Rms(result->control.after), Rms(result->control.before)) << "seed " << seed;
    before += Rms(result->control.before) / sessions;
    after += Rms(result->control.after) / sessions;
  }
  std::cout << "control " << before * 1e3 << " -> " << after * 1e3 << " mm\n";
  EXPECT_NEAR(after, 0.19e-3, 0.03e-3);
}

}  // namespace
}  // namespace truepose
