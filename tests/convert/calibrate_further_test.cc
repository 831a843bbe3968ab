// Robots that were measured with less than a pose calibrate from file-like rows to the noise.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "convert/frames.h"
#include "convert/readings.h"
#include "convert/robot.h"
#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

constexpr int kRows = 160;
constexpr double kNoise_m = 2e-5;

Eigen::VectorXd RandomVector(int n, double range, Random* random) {
  return Eigen::VectorXd::NullaryExpr(n, [&] { return random->Uniform(-range, range); });
}

// Writes what is seen of the target at X_MT into row i.
using Instrument = std::function<void(int i, const Pose& X_MT, v1::Reading* row)>;

// A robot with errors of a millimetre and a milliradian, seen by an instrument.
class Measured {
 public:
  Measured()
      : nominal_(SampleNominal()),
        robot_(*RobotFrom(nominal_)),
        model_(ModifiedIncremental(robot_, ModelExtent::kInternal)) {}

  void See(const Instrument& instrument) {
    const Eigen::VectorXd lambda = RandomVector(model_.parameters.size(), 1e-3, &random_);
    const Pose X_MB{ExpRotation<double>(Eigen::Vector3d(RandomVector(3, 1, &random_))),
                    RandomVector(3, 1, &random_)};
    for (int i = 0; i < kRows; ++i) {
      v1::Reading* row = session_.add_readings();
      row->set_row(i);
      const Eigen::VectorXd q = RandomVector(6, 1.3, &random_);
      for (const double value : q) row->add_joints_measured(value);
      Pose X_MT = X_MB * Forward(model_, robot_.joint_map().ToChain(q), lambda) * Tool();
      for (double& x : X_MT.p) x += kNoise_m * random_.Normal();
      instrument(i, X_MT, row);
    }
  }

  // Even rows calibrate, odd ones control.
  CalibrationResult Calibrate() const {
    auto readings = ReadingsFrom(nominal_, robot_, {&session_}, options_);
    EXPECT_TRUE(readings.ok()) << readings.status();
    CalibrationProblem& problem = readings->problem;
    problem.robot = &robot_;
    problem.X_FT_nominal = Tool();
    for (const int position : readings->position) problem.calibrates.push_back(position % 2 == 0);
    const auto result = truepose::Calibrate(problem, {}, {});
    EXPECT_TRUE(result.ok()) << result.status();
    return result.ok() ? *result : CalibrationResult();
  }

  Pose Tool() const { return PoseFrom(nominal_.tools(0).pose()); }

  Random random_{7};
  v1::Nominal nominal_;
  Robot robot_;
  Model model_;
  v1::SessionInput session_;
  v1::CalibrationOptions options_;
};

// Noise of each measured value, and of the 24 to 33 parameters that half of the rows determine:
// 1.2 to 1.5 times the noise. Errors of a millimetre that one parameter is missing for show at
// once.
void ExpectNoise(const CalibrationResult& result, double values_a_row) {
  const double after = PoseStatisticsOf(result.control.after).position_m.rms;
  const double before = PoseStatisticsOf(result.control.before).position_m.rms;
  EXPECT_LT(after, 1.7 * kNoise_m * std::sqrt(values_a_row));
  EXPECT_GT(before, 10 * after);
}

int Rank(const CalibrationResult& result) {
  return static_cast<int>(result.identification.set.active.size());
}

// 27 for one point off the last axis (30 less the turns of the target); two more points bring three
// each.
TEST(CalibrateFurther, ThreePointsAReading) {
  Measured measured;
  measured.See([](int, const Pose& X_MT, v1::Reading* row) {
    for (int k = 0; k < 3; ++k) {
      v1::MeasuredPoint* point = row->add_points();
      point->set_target("p" + std::to_string(k + 1));
      const Eigen::Vector3d side = (k == 0 ? 0 : 0.1) * Eigen::Vector3d::Unit(k);
      *point->mutable_position_m() = ToProto(Eigen::Vector3d(X_MT * side));
    }
  });
  const CalibrationResult result = measured.Calibrate();
  EXPECT_EQ(Rank(result), 33);
  ExpectNoise(result, 3);
}

// A height leaves three motions of the base unseen, a place in the plane one.
TEST(CalibrateFurther, SingleCoordinates) {
  for (const auto& [coordinates, rank] : {std::pair("z", 24), std::pair("xy", 26)}) {
    SCOPED_TRACE(coordinates);
    Measured measured;
    measured.See([&](int, const Pose& X_MT, v1::Reading* row) {
      *row->mutable_position_m() = ToProto(X_MT.p);
      row->set_coordinates(coordinates);
    });
    const CalibrationResult result = measured.Calibrate();
    EXPECT_EQ(Rank(result), rank);
    ExpectNoise(result, static_cast<double>(std::string(coordinates).size()));
  }
}

// Catches: planes that do not share their frame (each alone would leave three motions of its own).
TEST(CalibrateFurther, ThreePlanesOfOneFixture) {
  Measured measured;
  const Eigen::Vector3d turns[] = {
      {0, 0, 0}, {std::numbers::pi / 2, 0, 0}, {0, std::numbers::pi / 2, 0}};
  measured.See([&](int i, const Pose& X_MT, v1::Reading* row) {
    const Eigen::Matrix3d R = ExpRotation<double>(turns[i % 3]);
    const Eigen::Vector3d normal = R.col(2);
    v1::Feature* feature = measured.options_.mutable_fixture()->add_features();
    feature->set_name(std::to_string(i));
    feature->set_kind(v1::FEATURE_PLANE);
    *feature->mutable_pose() = ToProto(Pose{R, normal * normal.dot(X_MT.p)});
    row->set_feature(feature->name());
  });
  const CalibrationResult result = measured.Calibrate();
  EXPECT_EQ(Rank(result), 27);
  ExpectNoise(result, 1);
}

// Four points that nobody measured: twelve coordinates in B, less what the robot shares with them.
TEST(CalibrateFurther, DistancesToUnknownPoints) {
  Measured measured;
  const Eigen::Vector3d anchors[] = {
      {0.5, 0.5, 0.1}, {1, -0.7, 0.3}, {-0.6, 0.9, 0.8}, {0.2, 0.2, 1.5}};
  measured.See([&](int i, const Pose& X_MT, v1::Reading* row) {
    row->set_distance_m((X_MT.p - anchors[i % 4]).norm());
    row->set_anchor("anchor " + std::to_string(i % 4));
  });
  ExpectNoise(measured.Calibrate(), 1);
}

// The point features of a fixture, whose places are known in one frame.
constexpr std::array<std::array<double, 3>, 4> kKnown = {
    {{0.5, 0.5, 0.1}, {1, -0.7, 0.3}, {-0.6, 0.9, 0.8}, {0.2, 0.2, 1.5}}};

// Rows come in pairs of one calibration and one control row, so that both see every anchor.
int AnchorOf(int row) { return row / 2 % 4; }

v1::Reading* SeeDistance(int i, const Pose& X_MT, v1::Reading* row) {
  row->set_distance_m((X_MT.p - Eigen::Vector3d(kKnown[AnchorOf(i)].data())).norm());
  row->set_anchor("anchor " + std::to_string(AnchorOf(i)));
  return row;
}

void AddKnownAnchors(v1::CalibrationOptions* options) {
  for (size_t k = 0; k < kKnown.size(); ++k) {
    v1::Feature* feature = options->mutable_fixture()->add_features();
    feature->set_name("anchor " + std::to_string(k));
    feature->set_kind(v1::FEATURE_POINT);
    *feature->mutable_pose() =
        ToProto(Pose{Eigen::Matrix3d::Identity(), Eigen::Vector3d(kKnown[k].data())});
  }
}

// Catches: a start at the wrong minimum (51 mm before, 50.7 after), anchors that do not share the
// fixture's frame.
TEST(CalibrateFurther, DistancesToKnownPoints) {
  Measured measured;
  AddKnownAnchors(&measured.options_);
  measured.See(SeeDistance);
  const CalibrationResult result = measured.Calibrate();
  EXPECT_EQ(Rank(result), 27);
  ExpectNoise(result, 1);
}

// Catches: a constant that no start looks for, to points that are known and to others.
TEST(CalibrateFurther, BeamsWithAnUnknownConstant) {
  constexpr double kConstant_m = -0.75;
  for (const bool known : {true, false}) {
    SCOPED_TRACE(known);
    Measured measured;
    if (known) AddKnownAnchors(&measured.options_);
    measured.See([](int i, const Pose& X_MT, v1::Reading* row) {
      SeeDistance(i, X_MT, row)->set_distance_m(row->distance_m() + kConstant_m);
      row->set_beam("laser");
    });
    const CalibrationResult result = measured.Calibrate();
    ExpectNoise(result, 1);
    ASSERT_EQ(result.identification.estimate.offsets.size(), 1);
    // Fifty times the noise: the constant is as good as the lengths that it is told apart from.
    EXPECT_NEAR(result.identification.estimate.offsets(0), kConstant_m, 1e-3);
  }
}

}  // namespace
}  // namespace truepose::convert
