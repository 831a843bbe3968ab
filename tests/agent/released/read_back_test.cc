// Controllers that run known parameters, and what their reported poses tell.
#include "client/agent/released/read_back.h"

#include <numbers>

#include "compensation/kinematics.h"
#include "core/base/random.h"
#include "gtest/gtest.h"
#include "tests/agent/released/test_table.h"
#include "tests/server/testing/expect_status.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::agent {
namespace {

using testing::TestTable;
using truepose::testing::IsOk;

constexpr double kPi = std::numbers::pi;

Pose PoseOf(const Eigen::Vector3d& p, const Eigen::Vector3d& r) {
  return {ExpRotation<double>(r), p};
}

// A cell whose base and tool are turned far from the identity.
Frames SomeFrames() {
  return {PoseOf({1.2, -0.7, 0.4}, {0.3, -1.1, 2.0}), PoseOf({0.05, 0.12, 0.31}, {2.2, 0.4, -0.9})};
}

class ReadBackTest : public ::testing::Test {
 protected:
  ReadBackTest() {
    Disk disk;
    ReleasedStore store(ReleasedCache(folder_.File("arm"), "robots/arm", disk),
                        [](const std::string&) {});
    for (const TestTable* table : {&older_, &active_})
      EXPECT_THAT(store.Offer(table->entry, [&] { return table->bytes; }), IsOk());
    state_ = store.state();
  }

  // What a controller reports whose flange is at flange(q), rounded as controllers do: by the
  // standard deviation of a uniform rounding, 1/sqrt(12) of its step.
  template <typename Flange>
  std::vector<ReportedPose> Report(int poses, Flange flange, double step_m = 1e-5,
                                   double step_rad = 1e-5) {
    Random random(3);
    std::vector<ReportedPose> reported;
    for (int i = 0; i < poses; ++i) {
      ReportedPose& pose = reported.emplace_back();
      for (int joint = 0; joint < 6; ++joint) pose.joints.push_back(random.Uniform(-2, 2));
      pose.X_WT = frames_.X_WB * flange(pose.joints.data()) * frames_.X_FT;
      for (int k = 0; k < 3; ++k) pose.X_WT.p(k) += random.Uniform(-step_m, step_m) / 2;
      Eigen::Vector3d turn;
      for (int k = 0; k < 3; ++k) turn(k) = random.Uniform(-step_rad, step_rad) / 2;
      pose.X_WT.R = ExpRotation<double>(turn) * pose.X_WT.R;
    }
    return reported;
  }
  std::vector<ReportedPose> ReportOf(int poses, const TestTable& table, double step_m = 1e-5) {
    return Report(
        poses,
        [&](const double* q) { return compensation::IdentifiedFlange(table.content.arm, q); },
        step_m);
  }
  std::vector<ReportedPose> ReportNominal(int poses) {
    return Report(poses, [&](const double* q) {
      return compensation::NominalFlange(active_.content.arm, q);
    });
  }

  truepose::testing::TempDir folder_;
  const TestTable older_{1}, active_{2}, other_{3};
  Frames frames_ = SomeFrames();
  std::shared_ptr<const ReleasedState> state_;
};

// Would catch hypotheses that are mixed up, and frames that take the difference with them.
TEST_F(ReadBackTest, TellsWhichParametersRun) {
  const struct {
    std::vector<ReportedPose> poses;
    std::string state, parameters;
  } cases[] = {{ReportNominal(8), "nominal", "nominal"},
               {ReportOf(8, active_), "active", active_.entry.calibration},
               {ReportOf(8, older_), "older", older_.entry.calibration},
               {ReportOf(8, other_), "unknown", ""}};
  for (const auto& one : cases) {
    const ReadBackResult result = ReadBack(*state_, one.poses, {});
    EXPECT_EQ(result.controller_state, one.state);
    EXPECT_EQ(result.parameters, one.parameters);
    ASSERT_EQ(result.fits.size(), 3U);
    // Rounding to 10 um leaves 5 um (three coordinates), the least change of a set 100 um.
    const double best = result.fits[0].fit.position_rms_m;
    EXPECT_EQ(best < 6e-6, one.state != "unknown") << one.state << " " << best;
    EXPECT_GT(result.fits[1].fit.position_rms_m, 3e-5) << one.state;
  }
}

// Would catch known frames that are not used, or are the other way round.
TEST_F(ReadBackTest, WithKnownFrames) {
  ReadBackOptions options;
  options.frames = frames_;
  const ReadBackResult result = ReadBack(*state_, ReportOf(4, older_), options);
  EXPECT_EQ(result.controller_state, "older");
  EXPECT_EQ(result.fits[0].fit.degrees_of_freedom, 24);
  options.frames->X_FT.p.x() += 1e-3;
  EXPECT_EQ(ReadBack(*state_, ReportOf(4, older_), options).controller_state, "unknown");
}

// Would catch an answer from too little, and a number of poses that is not enough.
TEST_F(ReadBackTest, AsksForAsManyPosesAsItTakes) {
  for (int poses = 0; poses < kFewestPoses; ++poses) {
    const ReadBackResult result = ReadBack(*state_, ReportOf(poses, active_), {});
    EXPECT_EQ(result.controller_state, "undecided");
    EXPECT_EQ(result.more_poses, kFewestPoses - poses);
  }
  // A controller that prints 0.5 mm and 0.03 deg: its sets are 0.1 mm apart.
  ReadBackOptions coarse;
  coarse.noise = {5e-4, 5e-4};
  const auto few = ReportOf(6, active_, 5e-4);
  const ReadBackResult result = ReadBack(*state_, few, coarse);
  ASSERT_EQ(result.controller_state, "undecided");
  ASSERT_GT(result.more_poses, 6);
  // Half as many again: the expected value of the evidence is what the number is for.
  const int enough = 6 + result.more_poses + result.more_poses / 2;
  EXPECT_EQ(ReadBack(*state_, ReportOf(enough, active_, 5e-4), coarse).controller_state, "active");

  coarse.noise = {0.1, 0.1};
  const ReadBackResult hopeless = ReadBack(*state_, few, coarse);
  EXPECT_EQ(hopeless.controller_state, "undecided");
  EXPECT_EQ(hopeless.more_poses, 0);
}

// Would catch a fit that ends in a wrong place, or counts what it can't determine.
TEST_F(ReadBackTest, FramesAreFound) {
  Random random(7);
  for (int round = 0; round < 50; ++round) {
    const auto draw = [&](double size) {
      return Eigen::Vector3d(random.Uniform(-size, size), random.Uniform(-size, size),
                             random.Uniform(-size, size));
    };
    const Frames frames = {PoseOf(draw(2), draw(1.8)), PoseOf(draw(0.5), draw(1.8))};
    const bool same_orientation = round % 5 == 0;
    std::vector<PosePair> pairs;
    for (int i = 0; i < 5; ++i) {
      const Pose X_BF =
          PoseOf(draw(1), same_orientation ? Eigen::Vector3d(0, kPi / 2, 0) : draw(1.5));
      pairs.push_back({X_BF, frames.X_WB * X_BF * frames.X_FT});
    }
    const FrameFit fit = FitFrames(pairs, {});
    EXPECT_LT(fit.position_largest_m, 1e-9) << round;
    // With one orientation the tool's point and the base's shift can't be told apart, nor their
    // turns.
    EXPECT_EQ(fit.degrees_of_freedom, same_orientation ? 30 - 9 : 30 - 12) << round;
    if (!same_orientation) {
      EXPECT_LT((fit.frames.X_FT.p - frames.X_FT.p).norm(), 1e-8) << round;
    }
  }
}

}  // namespace
}  // namespace truepose::agent
