// Rows of sessions become core readings that are right in the physics: at the true frames every
// kind of measurement has a residual of zero, and each under the frame, target and constant that it
// belongs to.
#include "convert/readings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "convert/frames.h"
#include "convert/robot.h"
#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "core/identification/prediction.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Eigen::VectorXd RandomVector(int n, double range, Random* random) {
  return Eigen::VectorXd::NullaryExpr(n, [&] { return random->Uniform(-range, range); });
}

Pose RandomPose(double angle, double length, Random* random) {
  return {ExpRotation<double>(Eigen::Vector3d(RandomVector(3, angle, random))),
          RandomVector(3, length, random)};
}

// A robot without errors, where it stands, and rows of what would be seen of it.
class World {
 public:
  World()
      : robot_(*RobotFrom(SampleNominal())),
        model_(ModifiedIncremental(robot_, ModelExtent::kInternal)),
        X_MB_(RandomPose(1.5, 2, &random_)),
        X_FT_(RandomPose(1, 0.2, &random_)) {}

  v1::Reading* AddRow() {
    v1::Reading* row = session_.add_readings();
    row->set_row(session_.readings_size() - 1);
    const Eigen::VectorXd q = RandomVector(6, 1.5, &random_);
    for (const double value : q) row->add_joints_measured(value);
    X_MT_ = X_MB_ * NominalForward(robot_, q) * X_FT_;
    return row;
  }

  v1::Feature* AddFeature(const std::string& name, v1::FeatureKind kind, const Pose& X) {
    v1::Feature* feature = options_.mutable_fixture()->add_features();
    feature->set_name(name);
    feature->set_kind(kind);
    *feature->mutable_pose() = ToProto(X);
    return feature;
  }

  ReadingsProblem Convert() const {
    auto problem = ReadingsFrom(SampleNominal(), robot_, {&session_}, options_);
    EXPECT_TRUE(problem.ok()) << problem.status();
    return problem.ok() ? *std::move(problem) : ReadingsProblem();
  }

  // Of all readings with every base at X_MB and every target at X_FT, but those that `estimate` is
  // changed in.
  template <typename Change>
  double LargestResidual(const ReadingsProblem& readings, Change change) const {
    const CalibrationProblem& whole = readings.problem;
    const Problem problem{&model_, whole.readings, whole.placements, whole.targets, whole.offsets};
    Estimate estimate = NominalEstimate(problem);
    std::fill(estimate.X_MB.begin(), estimate.X_MB.end(), X_MB_);
    std::fill(estimate.X_FT.begin(), estimate.X_FT.end(), X_FT_);
    change(&estimate);
    double largest = 0;
    for (const Reading& reading : problem.readings)
      largest = std::max(largest, ResidualAt(problem, reading, estimate).cwiseAbs().maxCoeff());
    return largest;
  }
  double LargestResidual(const ReadingsProblem& readings) const {
    return LargestResidual(readings, [](Estimate*) {});
  }

  Random random_{5};
  Robot robot_;
  Model model_;
  Pose X_MB_, X_FT_;
  Pose X_MT_;  // of the row that was added last
  v1::SessionInput session_;
  v1::CalibrationOptions options_;
};

// Sums of a few products of metres: 1e-15 each; quaternions that are rounded once.
constexpr double kExact = 1e-12;

// Catches: points on one target, a point that takes another's place, a row that loses its name,
// points of one row that count as independent.
TEST(ReadingsFrom, EachPointIsAReadingOfItsOwnTarget) {
  World world;
  const Eigen::Vector3d offset(0.1, 0.02, -0.05);
  for (int i = 0; i < 8; ++i) {
    v1::Reading* row = world.AddRow();
    v1::MeasuredPoint* p1 = row->add_points();
    p1->set_target("p1");
    *p1->mutable_position_m() = ToProto(world.X_MT_.p);
    p1->mutable_position_sd_m()->set_y(2e-5);
    if (i == 3) continue;
    v1::MeasuredPoint* p2 = row->add_points();
    p2->set_target("p2");
    *p2->mutable_position_m() = ToProto(Eigen::Vector3d(world.X_MT_ * offset));
  }
  world.session_.mutable_readings(5)->set_target("frame");
  const ReadingsProblem readings = world.Convert();
  ASSERT_EQ(readings.problem.readings.size(), 15u);
  EXPECT_THAT(readings.problem.targets, ElementsAre("p1", "p2", "frame/p1", "frame/p2"));
  EXPECT_EQ(readings.problem.placements.size(), 1u);
  EXPECT_EQ(readings.problem.readings[0].position_sd_m.y(), 2e-5);
  EXPECT_EQ(readings.rows[1].row, 0);
  EXPECT_EQ(readings.rows[7].row, 4);
  EXPECT_EQ(readings.position[7], 4);
  EXPECT_EQ(readings.problem.readings[0].row, readings.problem.readings[1].row);
  EXPECT_NE(readings.problem.readings[1].row, readings.problem.readings[2].row);
  for (int i = 0; i < 15; ++i) EXPECT_EQ(readings.problem.readings[i].id, i);
  EXPECT_LT(world.LargestResidual(readings,
                                  [&](Estimate* estimate) {
                                    estimate->X_FT[1].p = estimate->X_FT[3].p =
                                        world.X_FT_ * offset;
                                  }),
            kExact);
}

TEST(ReadingsFrom, SingleCoordinates) {
  World world;
  const char* coordinates[] = {"z", "xy", "y", "xz"};
  for (const char* some : coordinates) {
    v1::Reading* row = world.AddRow();
    row->set_coordinates(some);
    *row->mutable_position_m() = ToProto(world.X_MT_.p);
    row->mutable_position_sd_m()->set_z(3e-5);
  }
  const ReadingsProblem readings = world.Convert();
  ASSERT_EQ(readings.problem.readings.size(), 4u);
  EXPECT_EQ(readings.problem.readings[0].kind, ObservationKind::kCoordinates);
  EXPECT_EQ(RowsOf(readings.problem.readings[0]), 1);
  EXPECT_EQ(RowsOf(readings.problem.readings[3]), 2);
  EXPECT_EQ(readings.problem.readings[0].position_sd_m.z(), 3e-5);
  EXPECT_LT(world.LargestResidual(readings), kExact);
  world.options_.set_observe(v1::POINT);
  EXPECT_THAT(world.Convert().problem.readings, IsEmpty());
}

// Catches: an anchor in the wrong frame, an unknown one that shares the placement's frame, beams
// mixed up.
TEST(ReadingsFrom, DistancesToKnownAndUnknownPoints) {
  World world;
  const Eigen::Vector3d cone(0.5, -0.2, 0.1), floor(2, 1, -1);
  world.AddFeature("cone", v1::FEATURE_POINT, {Eigen::Matrix3d::Identity(), cone});
  world.options_.mutable_fixture()->mutable_features(0)->mutable_covariance()->Resize(36, 0.0);
  world.options_.mutable_fixture()->mutable_features(0)->set_covariance(7, 4e-10);
  const auto add = [&](const std::string& anchor, const Eigen::Vector3d& from,
                       const std::string& beam, double constant) {
    v1::Reading* row = world.AddRow();
    row->set_anchor(anchor);
    row->set_beam(beam);
    row->set_distance_m((world.X_MT_.p - from).norm() + constant);
    row->set_distance_sd_m(5e-5);
  };
  for (int i = 0; i < 3; ++i) {
    add("cone", cone, "", 0);
    add("floor", floor, "", 0);
    add("cone", cone, "laser", -3);
    add("floor", floor, "laser 2", 1);
  }
  const ReadingsProblem readings = world.Convert();
  EXPECT_THAT(readings.problem.placements, ElementsAre("", "floor"));
  EXPECT_THAT(readings.problem.offsets, ElementsAre("laser", "laser 2"));
  ASSERT_EQ(readings.problem.readings.size(), 12u);
  const Reading& first = readings.problem.readings[0];
  EXPECT_EQ(first.position_sd_m.x(), 5e-5);
  EXPECT_TRUE(first.contact);
  ASSERT_TRUE(first.covariance.has_value());
  EXPECT_EQ((*first.covariance)(1, 1), 4e-10);
  EXPECT_EQ(readings.problem.readings[1].anchor_M, Eigen::Vector3d::Zero());
  EXPECT_LT(world.LargestResidual(readings,
                                  [&](Estimate* estimate) {
                                    estimate->X_MB[1].p -= floor;
                                    estimate->offsets = Eigen::Vector2d(-3, 1);
                                  }),
            kExact);
}

// Catches: a feature's z axis for its x axis, a plane that holds the tool within it, a position
// that is taken although the tool stands in a feature.
TEST(ReadingsFrom, ContactsByKindOfFeature) {
  World world;
  const auto add = [&](const std::string& name, v1::FeatureKind kind, const Pose& X_TS) {
    v1::Reading* row = world.AddRow();
    row->set_feature(name);
    world.AddFeature(name, kind, world.X_MT_ * X_TS);
  };
  const Eigen::Matrix3d roll = ExpRotation<double>(Eigen::Vector3d(0, 0, 0.7));
  const Eigen::Matrix3d any = ExpRotation<double>(Eigen::Vector3d(0.3, -0.4, 0.7));
  add("seat", v1::FEATURE_POSE, Pose{});
  add("cone", v1::FEATURE_POINT, {any, Eigen::Vector3d::Zero()});
  add("hole", v1::FEATURE_POINT_AXIS, {roll, Eigen::Vector3d::Zero()});
  add("top", v1::FEATURE_PLANE, {any, any * Eigen::Vector3d(0.3, -0.2, 0)});
  *world.session_.mutable_readings(1)->mutable_position_m() = ToProto(Eigen::Vector3d(9, 9, 9));
  world.options_.mutable_fixture()->mutable_features(2)->mutable_covariance()->Resize(36, 1e-9);
  const ReadingsProblem readings = world.Convert();
  ASSERT_EQ(readings.problem.readings.size(), 4u);
  std::vector<ObservationKind> kinds;
  for (const Reading& reading : readings.problem.readings) {
    kinds.push_back(reading.kind);
    EXPECT_TRUE(reading.contact);
  }
  EXPECT_THAT(kinds, ElementsAre(ObservationKind::kPose, ObservationKind::kPoint,
                                 ObservationKind::kPointAxis, ObservationKind::kPlane));
  EXPECT_LT(world.LargestResidual(readings), kExact);
  EXPECT_EQ((*readings.problem.readings[2].covariance)(3, 5), 1e-9);
  EXPECT_FALSE(readings.problem.readings[0].covariance.has_value());
  EXPECT_THAT(readings.warnings,
              ElementsAre("1 rows stand in a feature: their measured positions are not used (rows "
                          "1)"));
}

// Catches: more taken from a contact than was asked for.
TEST(ReadingsFrom, ObserveTakesLessOfAContact) {
  World world;
  for (const auto& [name, kind] :
       {std::pair("seat", v1::FEATURE_POSE), std::pair("hole", v1::FEATURE_POINT_AXIS),
        std::pair("cone", v1::FEATURE_POINT), std::pair("top", v1::FEATURE_PLANE)}) {
    world.AddRow()->set_feature(name);
    world.AddFeature(name, kind, world.X_MT_);
  }
  const auto kinds = [&](v1::Observe observe) {
    world.options_.set_observe(observe);
    std::vector<ObservationKind> found;
    for (const Reading& reading : world.Convert().problem.readings) found.push_back(reading.kind);
    return found;
  };
  using enum ObservationKind;
  EXPECT_THAT(kinds(v1::POSE), ElementsAre(kPose));
  EXPECT_THAT(kinds(v1::POINT_AXIS), ElementsAre(kPointAxis, kPointAxis));
  EXPECT_THAT(kinds(v1::POINT), ElementsAre(kPoint, kPoint, kPoint));
}

// Catches: a column of features that is not looked up, rows of another session shifted.
TEST(ReadingsFrom, AnotherColumnOfFeatures) {
  World world;
  world.session_.mutable_session()->add_extra_columns("hole");
  for (const char* hole : {"b", "", "a"}) {
    world.AddRow()->add_extra_values(hole);
    if (*hole != '\0') world.AddFeature(hole, v1::FEATURE_POINT, world.X_MT_);
  }
  world.options_.set_feature_column("hole");
  const ReadingsProblem readings = world.Convert();
  ASSERT_EQ(readings.problem.readings.size(), 2u);
  EXPECT_EQ(readings.rows[1].row, 2);
  EXPECT_LT(world.LargestResidual(readings), kExact);
  EXPECT_THAT(readings.warnings, ElementsAre(HasSubstr("1 rows are not used")));
}

// Catches: commanded joints where measured ones were asked for.
TEST(ReadingsFrom, MeasuredOrCommandedJoints) {
  World world;
  for (int i = 0; i < 3; ++i) {
    v1::Reading* row = world.AddRow();
    *row->mutable_position_m() = ToProto(world.X_MT_.p);
    if (i != 1) *row->mutable_joints_commanded() = row->joints_measured();
    if (i != 1) row->set_joints_commanded(0, 9);
    if (i == 2) row->clear_joints_measured();
  }
  const auto first_joints = [&](const std::string& joints) {
    world.options_.set_joints(joints);
    std::vector<bool> commanded;
    for (const Reading& reading : world.Convert().problem.readings)
      commanded.push_back(reading.q(0) == 9);
    return commanded;
  };
  EXPECT_THAT(first_joints(""), ElementsAre(false, false, true));
  EXPECT_THAT(first_joints("both"), ElementsAre(false, false, true));
  EXPECT_THAT(first_joints("measured"), ElementsAre(false, false));
  EXPECT_THAT(first_joints("commanded"), ElementsAre(true, true));
  EXPECT_EQ(world.Convert().joints_used, "commanded");
}

// Catches: noise of a controller's joint that is given to the chain's joint of the same number.
TEST(ReadingsFrom, JointNoiseGoesThroughTheJointMap) {
  World world;
  *world.AddRow()->mutable_position_m() = ToProto(world.X_MT_.p);
  world.options_.add_joint_sd(2e-4);
  EXPECT_EQ(world.Convert().problem.readings[0].joint_sd, Eigen::VectorXd::Constant(6, 2e-4));
  world.options_.set_joint_sd(0, 0);
  EXPECT_EQ(world.Convert().problem.readings[0].joint_sd.size(), 0);
  v1::Nominal coupled = SampleNominal();
  for (int i = 0; i < 36; ++i) coupled.mutable_joint_map()->add_scale(i % 7 == 0 ? 1 : 0);
  coupled.mutable_joint_map()->set_scale(2 * 6 + 1, 1);  // joint 3 is counted from joint 2
  world.options_.clear_joint_sd();
  for (const double sd : {1.0, 3.0, 4.0, 0.0, 0.0, 2.0}) world.options_.add_joint_sd(sd * 1e-4);
  const Robot robot = *RobotFrom(coupled);
  const auto readings = ReadingsFrom(coupled, robot, {&world.session_}, world.options_);
  ASSERT_TRUE(readings.ok()) << readings.status();
  const Eigen::VectorXd& sd = readings->problem.readings[0].joint_sd;
  EXPECT_NEAR(sd(1), 3e-4, 1e-18);
  EXPECT_NEAR(sd(2), 5e-4, 1e-18);
  EXPECT_EQ(sd(3), 0);
}

// Catches: degrees Celsius taken for a difference, one session's mean for the other's.
TEST(ReadingsFrom, TorquesAndTemperatures) {
  World world;
  for (const double celsius : {20.0, 22.0, 24.0}) {
    v1::Reading* row = world.AddRow();
    *row->mutable_position_m() = ToProto(world.X_MT_.p);
    row->set_temperature_c(celsius);
    for (int i = 0; i < 6; ++i) row->add_joint_torques_nm(i + celsius);
  }
  v1::SessionInput cold = world.session_;
  for (v1::Reading& row : *cold.mutable_readings()) row.set_temperature_c(5);
  cold.mutable_readings(1)->clear_temperature_c();
  cold.mutable_readings(2)->clear_joint_torques_nm();
  const auto readings = ReadingsFrom(SampleNominal(), world.robot_, {&world.session_, &cold},
                                     v1::CalibrationOptions());
  ASSERT_TRUE(readings.ok()) << readings.status();
  const std::vector<Reading>& all = readings->problem.readings;
  EXPECT_EQ(all[0].conditions.temperature_K, -2);
  EXPECT_EQ(all[2].conditions.temperature_K, 2);
  EXPECT_EQ(all[3].conditions.temperature_K, 0);
  EXPECT_EQ(all[4].conditions.temperature_K, 0);
  EXPECT_EQ(all[1].conditions.joint_torque(5), 27);
  EXPECT_EQ(all[5].conditions.joint_torque.size(), 0);
}

// Catches: two sessions whose unnamed things become one.
TEST(ReadingsFrom, WhatHasNoNameBelongsToItsSession) {
  World world;
  v1::Reading* row = world.AddRow();
  row->add_points()->set_target("p1");
  *row->mutable_points(0)->mutable_position_m() = ToProto(world.X_MT_.p);
  row->set_distance_m(1);
  row->set_anchor("A");
  row->set_beam("b");
  v1::SessionInput other = world.session_;
  other.mutable_readings(0)->set_distance_m(2);
  const auto readings = ReadingsFrom(SampleNominal(), world.robot_, {&world.session_, &other},
                                     v1::CalibrationOptions());
  ASSERT_TRUE(readings.ok()) << readings.status();
  EXPECT_THAT(readings->problem.placements,
              ElementsAre("session 1", "session 1/A", "session 2", "session 2/A"));
  EXPECT_THAT(readings->problem.targets,
              ElementsAre("session 1/p1", "session 1", "session 2/p1", "session 2"));
  EXPECT_THAT(readings->problem.offsets, ElementsAre("session 1/b", "session 2/b"));
}

}  // namespace
}  // namespace truepose::convert
