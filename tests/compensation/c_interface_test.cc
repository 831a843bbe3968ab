// The interface that is installed, in C and its C++ wrapper, over the tree's own library.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>
#include <string>

#include "compensation/encode_table.h"
#include "compensation/exact.h"
#include "tests/compensation/table_samples.h"
#include "truepose/compensation.h"

namespace {

namespace runtime = truepose::compensation;

const std::vector<std::byte>& Bytes() {
  static const auto* bytes = new std::vector<std::byte>([] {
    auto content = runtime::testing::Ur10Content(runtime::testing::Ur10Arm(3e-4), {6, 6, 4, 4});
    runtime::testing::FillNodes(&content);
    content.header.worst = {1e-5, 2e-5};
    return runtime::Encode(content);
  }());
  return *bytes;
}

std::span<const std::uint8_t> Span(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

truepose::Compensation Loaded() {
  truepose::Compensation robot;
  EXPECT_TRUE(robot.LoadBytes(Span(Bytes())));
  return robot;
}

const std::vector<double> kTarget = {0.1, -1.5, 1.5, -1.6, -1.5, 0.4};

TEST(CInterface, TellsWhatTheTableIs) {
  const truepose::Compensation robot = Loaded();
  const truepose::TableInfo info = robot.Info();
  EXPECT_EQ(info.schema, 1u);
  EXPECT_STREQ(info.serial, "2016300123");
  EXPECT_STREQ(info.robot, "robots/ur10");
  EXPECT_EQ(info.calibration_digest[31], 32);
  EXPECT_EQ(info.nominal_digest[0], 200);
  EXPECT_EQ(info.joints, 6);
  EXPECT_EQ(info.measuring, 0);
  EXPECT_EQ(info.worst_position_m, 1e-5);
  EXPECT_EQ(info.worst_rotation_rad, 2e-5);
  EXPECT_EQ(info.smallest_singular_value, 0.02);
}

TEST(CInterface, TellsTheAxes) {
  truepose_compensation* robot = nullptr;
  ASSERT_EQ(
      truepose_compensation_load_bytes(Bytes().data(), Bytes().size(), nullptr, &robot, nullptr),
      TRUEPOSE_LOAD_OK);
  truepose_axis axis;
  ASSERT_EQ(truepose_compensation_axis(robot, 3, &axis), 0);
  EXPECT_EQ(axis.weight[1], 1);
  EXPECT_EQ(axis.weight[3], 1);
  EXPECT_EQ(axis.weight[4], 0);
  EXPECT_EQ(axis.lower, -2.0);
  EXPECT_EQ(axis.nodes, 4);
  EXPECT_EQ(truepose_compensation_axis(robot, 6, &axis), -1);
  EXPECT_EQ(truepose_compensation_axis(robot, -1, &axis), -1);
  truepose_compensation_free(robot);
}

// The three corrections agree, and exact ones bring the identified flange to the nominal one's
// place.
TEST(CInterface, CorrectsByTableAndExactly) {
  const truepose::Compensation robot = Loaded();
  const truepose::Correction by_table = robot.CorrectJoints(kTarget);
  const truepose::Correction exactly = robot.CorrectJointsExactly(kTarget);
  const truepose::FlangeResult nominal = robot.NominalFlange(kTarget);
  const truepose::Correction of_pose = robot.CorrectPose(nominal.X_BF, kTarget);
  ASSERT_EQ(by_table.outcome, TRUEPOSE_OK);
  ASSERT_EQ(exactly.outcome, TRUEPOSE_OK);
  ASSERT_EQ(of_pose.outcome, TRUEPOSE_OK);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(of_pose.q[i], exactly.q[i], 1e-9);
    EXPECT_NEAR(by_table.q[i], exactly.q[i], 1e-4) << "a coarse table";
  }
  const truepose::FlangeResult reached = robot.IdentifiedFlange({exactly.q, 6});
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(reached.X_BF.p[i], nominal.X_BF.p[i], 1e-9);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(reached.X_BF.R[i], nominal.X_BF.R[i], 1e-9);
  const truepose::FlangeResult of_table = robot.TableFlange({by_table.q, 6});
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(of_table.X_BF.p[i], nominal.X_BF.p[i], 1e-9);
}

// R row by row, as the header says: the nominal flange is that of the tree.
TEST(CInterface, WritesRotationsRowByRow) {
  const truepose::Pose X = runtime::NominalFlange(runtime::testing::Ur10Arm(3e-4), kTarget.data());
  const truepose::FlangeResult found = Loaded().NominalFlange(kTarget);
  ASSERT_EQ(found.outcome, TRUEPOSE_OK);
  EXPECT_NEAR(found.X_BF.R[1], X.R(0, 1), 1e-12);
  EXPECT_NEAR(found.X_BF.R[5], X.R(1, 2), 1e-12);
  EXPECT_NEAR(found.X_BF.p[2], X.p(2), 1e-12);
}

TEST(CInterface, GivesOutcomesThrough) {
  const truepose::Compensation robot = Loaded();
  std::vector<double> q = kTarget;
  q[4] = 0.5;
  const truepose::Correction outside = robot.CorrectJoints(q);
  EXPECT_EQ(outside.outcome, TRUEPOSE_OUTSIDE_DOMAIN);
  EXPECT_EQ(outside.joint, 4);
  EXPECT_EQ(robot.TableFlange(q).outcome, TRUEPOSE_OUTSIDE_DOMAIN);
  EXPECT_EQ(robot.CorrectJointsExactly(q).outcome, TRUEPOSE_OK) << "exactly asks for no domain";
  truepose::FlangePose far = robot.NominalFlange(kTarget).X_BF;
  far.p[0] += 5;
  const truepose::Correction beyond = robot.CorrectPose(far, kTarget);
  EXPECT_NE(beyond.outcome, TRUEPOSE_OK);
  EXPECT_GT(beyond.position_error_m, 1) << "the arm is 1.3 m long";
  q[2] = NAN;
  EXPECT_EQ(robot.CorrectJoints(q).outcome, TRUEPOSE_INVALID_ARGUMENT);
  EXPECT_EQ(robot.NominalFlange(q).outcome, TRUEPOSE_INVALID_ARGUMENT);
}

// Empty objects, null pointers and joints of another robot are outcomes as well, never a crash.
TEST(CInterface, SurvivesMisuse) {
  const truepose::Compensation robot = Loaded(), empty;
  EXPECT_EQ(robot.CorrectJoints(std::vector<double>(5, 0.0)).outcome, TRUEPOSE_INVALID_ARGUMENT);
  EXPECT_EQ(empty.CorrectJoints(kTarget).outcome, TRUEPOSE_INVALID_ARGUMENT);
  EXPECT_EQ(empty.IdentifiedFlange(kTarget).outcome, TRUEPOSE_INVALID_ARGUMENT);
  EXPECT_EQ(empty.Info().joints, 0);
  EXPECT_EQ(empty.Info().robot, nullptr);
  EXPECT_EQ(truepose_compensation_correct_joints(nullptr, nullptr, nullptr),
            TRUEPOSE_INVALID_ARGUMENT);
  EXPECT_EQ(truepose_compensation_correct_pose(nullptr, nullptr, nullptr, nullptr),
            TRUEPOSE_INVALID_ARGUMENT);
  EXPECT_EQ(truepose_compensation_table_flange(nullptr, nullptr, nullptr),
            TRUEPOSE_INVALID_ARGUMENT);
  truepose_message message;
  EXPECT_EQ(truepose_compensation_load(nullptr, nullptr, nullptr, &message),
            TRUEPOSE_LOAD_INVALID_ARGUMENT);
  EXPECT_STREQ(message.text, "found a null pointer");
  truepose_compensation_free(nullptr);
  truepose_compensation_info(nullptr, nullptr);
}

TEST(CInterface, RefusesAnotherRobotsTable) {
  truepose::Compensation robot = Loaded();
  const truepose::LoadResult refused = robot.LoadBytes(Span(Bytes()), {"4711", nullptr, nullptr});
  EXPECT_EQ(refused.status, TRUEPOSE_LOAD_OTHER_ROBOT);
  EXPECT_STREQ(refused.message.text, "serial: found '2016300123', expected '4711'");
  const std::uint8_t digest[32] = {9};
  EXPECT_EQ(robot.LoadBytes(Span(Bytes()), {nullptr, digest, nullptr}).status,
            TRUEPOSE_LOAD_OTHER_NOMINAL);
  EXPECT_EQ(robot.LoadBytes(Span(Bytes()), {nullptr, nullptr, digest}).status,
            TRUEPOSE_LOAD_OTHER_CALIBRATION);
  EXPECT_EQ(robot.CorrectJoints(kTarget).outcome, TRUEPOSE_OK) << "keeps the table it had";
}

TEST(CInterface, MovesAndReplaces) {
  truepose::Compensation robot = Loaded();
  truepose::Compensation moved = std::move(robot);
  EXPECT_EQ(moved.CorrectJoints(kTarget).outcome, TRUEPOSE_OK);
  EXPECT_TRUE(moved.LoadBytes(Span(Bytes())));
  robot = std::move(moved);
  EXPECT_EQ(robot.CorrectJoints(kTarget).outcome, TRUEPOSE_OK);
}

// Every value has its own text: a log that says "unknown" helps nobody.
TEST(CInterface, NamesEveryStatus) {
  std::set<std::string> names;
  for (int i = TRUEPOSE_OK; i <= TRUEPOSE_INVALID_ARGUMENT; ++i)
    names.insert(truepose_outcome_text(static_cast<truepose_outcome>(i)));
  EXPECT_EQ(names.size(), 6u);
  names.clear();
  for (int i = TRUEPOSE_LOAD_OK; i <= TRUEPOSE_LOAD_INVALID_ARGUMENT; ++i)
    names.insert(truepose_load_status_text(static_cast<truepose_load_status>(i)));
  EXPECT_EQ(names.size(), 13u);
  EXPECT_EQ(names.count("unknown"), 0u);
  EXPECT_EQ(names.count("damaged"), 1u);
}

}  // namespace
