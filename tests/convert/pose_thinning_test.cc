#include "convert/pose_thinning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/base/fault.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

class PoseThinningTest : public ::testing::Test {
 protected:
  PoseThinningTest() : input_(SampleInput(60, "")) {
    input_.mutable_sessions(0)->mutable_session()->set_name("sessions/1");
    calibration_ = *RunCalibration(input_);
  }

  absl::StatusOr<ThinnedPoseSet> Thin(int poses) {
    return RunPoseThinning(input_.nominal(), calibration_, {&input_.sessions(0)}, poses);
  }

  v1::CalibrationInput input_;
  v1::Calibration calibration_;
};

// Each pose is a row of the session, with its own joints, once.
TEST_F(PoseThinningTest, PosesAreRowsOfTheSession) {
  const auto thinned = Thin(20);
  ASSERT_TRUE(thinned.ok()) << thinned.status();
  EXPECT_EQ(thinned->parameters, calibration_.report().parameters().identified());
  EXPECT_EQ(thinned->pose_set.origin(), "thinned from sessions/1");
  EXPECT_EQ(thinned->pose_set.purpose(), v1::POSE_SET_CALIBRATE);
  std::set<std::string> labels;
  for (const v1::PoseSetPose& pose : thinned->pose_set.poses()) {
    labels.insert(pose.label());
    const int row = std::stoi(pose.label().substr(pose.label().rfind(' ')));
    EXPECT_EQ(pose.label(), "sessions/1 row " + std::to_string(row));
    const auto& joints = input_.sessions(0).readings(row).joints_measured();
    EXPECT_TRUE(
        std::equal(joints.begin(), joints.end(), pose.joints().begin(), pose.joints().end()));
  }
  EXPECT_EQ(labels.size(), 20u);
}

// A robot is sent to where it was sent, not to where it was read to be.
TEST_F(PoseThinningTest, CommandedJointsGoFirst) {
  for (v1::Reading& row : *input_.mutable_sessions(0)->mutable_readings()) {
    *row.mutable_joints_commanded() = row.joints_measured();
    row.set_joints_commanded(0, row.joints_measured(0) + 0.25);
  }
  const auto thinned = Thin(10);
  ASSERT_TRUE(thinned.ok()) << thinned.status();
  const v1::PoseSetPose& pose = thinned->pose_set.poses(0);
  const int row = std::stoi(pose.label().substr(pose.label().rfind(' ')));
  EXPECT_EQ(pose.joints(0), input_.sessions(0).readings(row).joints_commanded(0));
}

// A calibration from the thinned poses is one: complete, as the header promises.
TEST_F(PoseThinningTest, FewPosesStillIdentifyEverything) {
  const auto thinned = Thin(12);
  ASSERT_TRUE(thinned.ok()) << thinned.status();
  v1::CalibrationInput few = input_;
  few.mutable_sessions(0)->clear_readings();
  for (const v1::PoseSetPose& pose : thinned->pose_set.poses()) {
    const int row = std::stoi(pose.label().substr(pose.label().rfind(' ')));
    v1::Reading* reading = few.mutable_sessions(0)->add_readings();
    *reading = input_.sessions(0).readings(row);
    reading->set_row(few.sessions(0).readings_size() - 1);
  }
  const auto again = RunCalibration(few);
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_EQ(again->report().parameters().identified(), thinned->parameters);
}

TEST_F(PoseThinningTest, Faults) {
  EXPECT_EQ(FaultsOf(Thin(2).status())[0].field, "poses");
  EXPECT_EQ(FaultsOf(Thin(61).status())[0], (Fault{"poses", "61", "at most the 60 candidates"}));
}

}  // namespace
}  // namespace truepose::convert
