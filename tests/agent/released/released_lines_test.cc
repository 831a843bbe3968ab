// What the TCP interface says of released sets.
#include "client/agent/released/released_lines.h"

#include <cmath>

#include "compensation/correct_by_table.h"
#include "gmock/gmock.h"
#include "tests/agent/released/test_table.h"
#include "tests/server/testing/expect_status.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::agent {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::TestTable;
using truepose::testing::FieldsOf;
using truepose::testing::HasCode;
using truepose::testing::IsOk;

class ReleasedLinesTest : public ::testing::Test {
 protected:
  ReleasedLinesTest()
      : store_(ReleasedCache(folder_.File("arm"), "robots/arm", disk_), [](const std::string&) {}) {
  }
  void Release() {
    ASSERT_THAT(store_.Offer(table_.entry, [&] { return table_.bytes; }), IsOk());
  }
  absl::StatusOr<Json> Ask(const std::string& line) const {
    const Json message = Json::parse(line);
    const std::string op = message.at("op");
    if (op == "correct") return CorrectLine(desk_, message);
    return op == "released" ? ReleasedLine(desk_, message) : ReadBackLine(desk_, message);
  }

  truepose::testing::TempDir folder_;
  Disk disk_;
  const TestTable table_{2};
  ReleasedStore store_;
  std::string said_;
  const ReleasedDesk desk_{
      .state = [this](const std::string& robot) -> std::shared_ptr<const ReleasedState> {
        return robot == "robots/arm" ? store_.state() : nullptr;
      },
      .on_read_back = [this](const std::string& robot,
                             const std::string& state) { said_ = robot + " " + state; }};
};

constexpr double kDegree = M_PI / 180;
constexpr compensation::JointArray kTarget = {0.1, -1.2, 1.3, -1.6, -1.5, 0.2};

// Would catch units that are mixed up, and an answer by the other way.
TEST_F(ReleasedLinesTest, CorrectsInTheUnitOfTheQuestion) {
  Release();
  const auto by_table =
      compensation::CorrectByTable(store_.state()->current->table(), kTarget.data());
  const auto exact = compensation::CorrectJoints(table_.content.arm, kTarget.data(), {});
  ASSERT_EQ(by_table.outcome, compensation::Outcome::kOk);
  const auto in_rad =
      Ask(R"({"op":"correct","robot":"arm","joints":[0.1,-1.2,1.3,-1.6,-1.5,0.2]})");
  ASSERT_THAT(in_rad, IsOk());
  Json degrees = Json::array();
  for (int i = 0; i < 6; ++i) degrees.push_back(kTarget[i] / kDegree);
  const auto in_degrees =
      Ask(Json{{"op", "correct"}, {"robot", "robots/arm"}, {"joints_deg", degrees}, {"exact", true}}
              .dump());
  ASSERT_THAT(in_degrees, IsOk());
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ((*in_rad)["joints"][i], by_table.q[i]) << i;
    // Two roundings of the target in degrees.
    EXPECT_NEAR((*in_degrees)["joints_deg"][i].get<double>() * kDegree, exact.q[i], 1e-12) << i;
  }
  EXPECT_EQ((*in_rad)["calibration"], "robots/arm/calibrations/2");
  EXPECT_EQ((*in_rad)["predicted_accuracy_95_mm"], 0.25);
  EXPECT_FALSE(in_rad->contains("joints_deg"));
}

// Would catch joints that are given though nobody should command them.
TEST_F(ReleasedLinesTest, WhatMustNotBeCommandedHasNoJoints) {
  Release();
  const auto outside =
      Ask(R"({"op":"correct","robot":"arm","joints":[0.1,1.2,1.3,-1.6,-1.5,0.2]})");
  ASSERT_THAT(outside, IsOk());
  EXPECT_EQ((*outside)["ok"], false);
  EXPECT_EQ((*outside)["outcome"], "outside_domain");
  EXPECT_THAT((*outside)["message"].get<std::string>(), HasSubstr("axis 2"));
  EXPECT_FALSE(outside->contains("joints"));
  const auto singular =
      Ask(R"({"op":"correct","robot":"arm","joints":[0.1,-1.2,1.3,-1.6,0,0.2],"exact":true})");
  ASSERT_THAT(singular, IsOk());
  EXPECT_EQ((*singular)["outcome"], "near_singular");
}

// Would catch a fault that is told alone, or a correction from nothing.
TEST_F(ReleasedLinesTest, Faults) {
  EXPECT_THAT(Ask(R"({"op":"correct","robot":"arm","joints":[1,2,3,4,5,6]})"),
              HasCode(absl::StatusCode::kFailedPrecondition));
  Release();
  EXPECT_THAT(Ask(R"({"op":"correct","robot":"other","joints":[1,2,3,4,5,6]})"),
              HasCode(absl::StatusCode::kNotFound));
  EXPECT_THAT(
      FieldsOf(Ask(R"({"op":"correct","robot":"arm","joints":null,"exact":1,"x":2})").status()),
      ElementsAre("joints", "exact", "x"));
  EXPECT_THAT(FieldsOf(Ask(R"({"op":"correct","robot":"arm","joints":[1,2,3,4,5]})").status()),
              ElementsAre("joints"));
  EXPECT_THAT(FieldsOf(Ask(R"({"op":"read_back","robot":"arm","position_sd_mm":0,"tool":{},)"
                           R"("poses":[{"joints":[1,2,3,4,5,6],"position_mm":[1,2,3]},7]})")
                           .status()),
              ElementsAre("position_sd_mm", "poses[0].quaternion", "poses[1]", "base"));
}

// Would catch a status that says less than who looks for a fault needs.
TEST_F(ReleasedLinesTest, SaysWhatRuns) {
  store_.SetWaiting("the server has no active calibration of it");
  const auto none = Ask(R"({"op":"released","robot":"arm"})");
  ASSERT_THAT(none, IsOk());
  EXPECT_EQ((*none)["waiting"], "the server has no active calibration of it");
  EXPECT_FALSE(none->contains("calibration"));
  Release();
  const auto released = Ask(R"({"op":"released","robot":"arm"})");
  ASSERT_THAT(released, IsOk());
  EXPECT_EQ((*released)["calibration"], "robots/arm/calibrations/2");
  EXPECT_EQ((*released)["sha256"], table_.entry.sha256);
  EXPECT_EQ((*released)["path"], folder_.File("arm/active.table"));
  EXPECT_EQ((*released)["problem"], "");
  EXPECT_EQ((*released)["waiting"], "");
}

// Would catch poses that are read in another way than controllers write them, in each of the three.
TEST_F(ReleasedLinesTest, ReadsBackInEachControllersManner) {
  Release();
  for (const std::string manner : {"quaternion", "rotation_vector", "abc_deg"}) {
    Json poses = Json::array();
    for (int i = 0; i < 6; ++i) {
      compensation::JointArray q{};
      for (int joint = 0; joint < 6; ++joint) q[joint] = std::sin(1.0 + 7 * i + 3 * joint);
      const Pose X = compensation::IdentifiedFlange(table_.content.arm, q.data());
      const Eigen::Vector4d quaternion = QuaternionOf<double>(X.R);
      const Eigen::Vector3d vector = LogRotation<double>(X.R);
      Json pose = {{"joints", std::vector<double>(q.begin(), q.begin() + 6)},
                   {"position_mm", {X.p.x() * 1e3, X.p.y() * 1e3, X.p.z() * 1e3}}};
      if (manner == "quaternion")
        pose[manner] = {quaternion(0), quaternion(1), quaternion(2), quaternion(3)};
      if (manner == "rotation_vector") pose[manner] = {vector(0), vector(1), vector(2)};
      if (manner == "abc_deg")
        pose[manner] = {std::atan2(X.R(1, 0), X.R(0, 0)) / kDegree, -std::asin(X.R(2, 0)) / kDegree,
                        std::atan2(X.R(2, 1), X.R(2, 2)) / kDegree};
      poses.push_back(pose);
    }
    const auto answer = Ask(Json{{"op", "read_back"}, {"robot", "arm"}, {"poses", poses}}.dump());
    ASSERT_THAT(answer, IsOk());
    EXPECT_EQ((*answer)["controller_state"], "active") << manner << *answer;
    EXPECT_THAT((*answer)["message"].get<std::string>(),
                HasSubstr("runs calibrations/2 (active): 0.0000 mm"));
    EXPECT_EQ(said_, "robots/arm active");
  }
}

}  // namespace
}  // namespace truepose::agent
