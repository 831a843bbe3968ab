// Every fault of further measurements, fixtures and the options of readings has its field, and
// comes with the others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "convert/fixture.h"
#include "convert/readings.h"
#include "convert/robot.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> Fields(const absl::Status& status) {
  std::vector<std::string> fields;
  for (const Fault& fault : FaultsOf(status)) fields.push_back(fault.field);
  return fields;
}

std::vector<v1::Reading> Rows(int count) {
  std::vector<v1::Reading> rows(count);
  for (int i = 0; i < count; ++i) {
    rows[i].set_row(i);
    for (int joint = 0; joint < 6; ++joint) rows[i].add_joints_measured(0.1 * i);
  }
  return rows;
}

TEST(ReadingFaults, Points) {
  std::vector<v1::Reading> rows = Rows(3);
  rows[0].add_points()->mutable_position_m();
  rows[1].add_points()->set_target("p1");
  for (int i = 0; i < 2; ++i) {
    v1::MeasuredPoint* point = rows[2].add_points();
    point->set_target("p1");
    point->mutable_position_m()->set_x(NAN);
    point->mutable_position_sd_m()->set_z(-1);
  }
  EXPECT_THAT(
      Fields(ValidateReadings(SampleNominal(), rows, 0)),
      ElementsAre("readings[0].points[0].target", "readings[1].points[0].position_m",
                  "readings[2].points[0].position_m.x", "readings[2].points[0].position_sd_m",
                  "readings[2].points[1].position_m.x", "readings[2].points[1].position_sd_m",
                  "readings[2].points[1].target"));
}

TEST(ReadingFaults, Coordinates) {
  std::vector<v1::Reading> rows = Rows(4);
  for (v1::Reading& row : rows) row.set_coordinates("z");
  for (int i = 0; i < 3; ++i) rows[i].mutable_position_m();
  rows[0].set_coordinates("zx");
  rows[1].set_coordinates("xyz");
  rows[2].mutable_orientation()->set_w(1);
  EXPECT_THAT(Fields(ValidateReadings(SampleNominal(), rows, 0)),
              ElementsAre("readings[0].coordinates", "readings[1].coordinates",
                          "readings[2].coordinates", "readings[3].coordinates"));
}

TEST(ReadingFaults, Distances) {
  std::vector<v1::Reading> rows = Rows(5);
  for (v1::Reading& row : rows) {
    row.set_distance_m(1);
    row.set_anchor("A");
  }
  rows[0].clear_anchor();
  rows[1].set_distance_m(-1);
  rows[2].set_distance_m(-1);
  rows[2].set_beam("laser");
  rows[3].set_distance_m(INFINITY);
  rows[4].set_distance_sd_m(-1);
  EXPECT_THAT(Fields(ValidateReadings(SampleNominal(), rows, 0)),
              ElementsAre("readings[0].anchor", "readings[1].distance_m", "readings[3].distance_m",
                          "readings[4].distance_sd_m"));
}

TEST(ReadingFaults, TorquesAndTemperatures) {
  std::vector<v1::Reading> rows = Rows(4);
  rows[0].add_joint_torques_nm(1);
  rows[1].set_temperature_c(NAN);
  rows[2].set_temperature_c(-300);
  for (int i = 0; i < 6; ++i) rows[3].add_joint_torques_nm(i == 4 ? NAN : 0);
  EXPECT_THAT(Fields(ValidateReadings(SampleNominal(), rows, 0)),
              ElementsAre("readings[0].joint_torques_nm", "readings[1].temperature_c",
                          "readings[2].temperature_c", "readings[3].joint_torques_nm[4]"));
}

v1::Feature FeatureNamed(const std::string& name) {
  v1::Feature feature;
  feature.set_name(name);
  feature.set_kind(v1::FEATURE_POINT);
  feature.mutable_pose()->set_qw(1);
  return feature;
}

v1::Fixture FixtureOf(const std::vector<std::string>& names) {
  v1::Fixture fixture;
  for (const std::string& name : names) *fixture.add_features() = FeatureNamed(name);
  return fixture;
}

TEST(FixtureFaults, AllAtOnce) {
  v1::Fixture fixture = FixtureOf({"a", "", "a", "d", "e"});
  fixture.mutable_features(1)->clear_kind();
  fixture.mutable_features(3)->mutable_pose()->set_qw(2);
  fixture.mutable_features(4)->add_covariance(1);
  EXPECT_THAT(Fields(ValidateFixture(fixture)),
              ElementsAre("features[1].name", "features[1].kind", "features[2].name",
                          "features[3].pose", "features[4].covariance"));
  EXPECT_THAT(Fields(ValidateFixture(v1::Fixture())), ElementsAre("features"));
  EXPECT_THAT(Fields(ValidateFixture(FixtureOf({"a", "b"}))), IsEmpty());
}

std::string CovarianceFault(const std::vector<std::array<double, 3>>& entries) {
  v1::Fixture fixture = FixtureOf({"a"});
  auto* covariance = fixture.mutable_features(0)->mutable_covariance();
  covariance->Resize(36, 0.0);
  for (const auto& [row, column, value] : entries)
    covariance->Set(static_cast<int>(6 * row + column), value);
  const auto faults = FaultsOf(ValidateFixture(fixture));
  return faults.empty() ? "" : faults[0].found;
}

// Catches: a matrix whose Cholesky factor is not a number in the middle of a fit; a right one, of
// micrometres and milliradians or singular, that is refused.
TEST(FixtureFaults, CovariancesThatAreNone) {
  EXPECT_EQ(CovarianceFault({}), "");
  EXPECT_EQ(CovarianceFault({{0, 0, 1e-12}, {3, 3, 1e-6}, {0, 3, 9e-10}, {3, 0, 9e-10}}), "");
  EXPECT_EQ(CovarianceFault({{0, 0, 4}, {1, 1, 9}, {0, 1, 6}, {1, 0, 6}}), "");  // singular
  EXPECT_EQ(CovarianceFault({{1, 1, -1e-12}}), "a negative variance");
  EXPECT_EQ(CovarianceFault({{1, 1, 1}, {2, 2, 1}, {1, 2, 0.5}}), "a matrix that is not symmetric");
  EXPECT_EQ(CovarianceFault({{1, 1, NAN}}), "a value that is not finite or far too large");
  EXPECT_THAT(CovarianceFault({{0, 0, 4}, {1, 1, 9}, {0, 1, 6.1}, {1, 0, 6.1}}),
              HasSubstr("an eigenvalue of -0.01"));
  EXPECT_THAT(CovarianceFault({{0, 0, 1e-12}, {3, 3, 1e-6}, {0, 3, 2e-9}, {3, 0, 2e-9}}),
              HasSubstr("an eigenvalue of -1"));
  EXPECT_THAT(CovarianceFault({{0, 1, 1e-9}, {1, 0, 1e-9}, {1, 1, 1e-6}}),
              HasSubstr("an eigenvalue of"));
}

// One session of a sample robot in which rows stand in a feature and nothing else is seen.
struct Setting {
  v1::Nominal nominal = SampleNominal();
  v1::SessionInput session;
  v1::CalibrationOptions options;

  Setting() {
    for (v1::Reading& row : Rows(3)) {
      row.set_feature("a");
      *session.add_readings() = row;
    }
    *options.mutable_fixture() = FixtureOf({"a", "b"});
  }

  absl::Status Status() const {
    return ReadingsFrom(nominal, *RobotFrom(nominal), {&session}, options).status();
  }
};

TEST(ReadingOptionFaults, TheSampleHasNone) {
  EXPECT_TRUE(Setting().Status().ok()) << Setting().Status();
}

// Catches: contacts that are dropped in silence.
TEST(ReadingOptionFaults, Features) {
  Setting unknown;
  for (const int row : {1, 2}) unknown.session.mutable_readings(row)->set_feature("A");
  EXPECT_THAT(Fields(unknown.Status()), ElementsAre("sessions[0].readings[1].feature"));
  EXPECT_THAT(std::string(unknown.Status().message()), HasSubstr("one of a, b"));
  Setting column;
  column.options.set_feature_column("hole");
  EXPECT_THAT(Fields(column.Status()), ElementsAre("options.feature_column"));
  Setting none;
  none.options.clear_fixture();
  EXPECT_THAT(Fields(none.Status()), ElementsAre("sessions[0].readings[0].feature"));
  none.options.set_feature_column("group");
  EXPECT_THAT(Fields(none.Status()),
              ElementsAre("options.feature_column", "sessions[0].readings[0].feature"));
  Setting unused;
  for (v1::Reading& row : *unused.session.mutable_readings()) row.clear_feature();
  EXPECT_THAT(Fields(unused.Status()), ElementsAre("options.fixture"));
}

// Without a fixture a feature says nothing about what was measured beside it.
TEST(ReadingOptionFaults, AFeatureBesideAMeasurementNeedsNoFixture) {
  Setting measured;
  measured.options.clear_fixture();
  for (v1::Reading& row : *measured.session.mutable_readings()) row.mutable_position_m();
  EXPECT_TRUE(measured.Status().ok()) << measured.Status();
}

TEST(ReadingOptionFaults, AllAtOnce) {
  Setting setting;
  setting.options.mutable_fixture()->mutable_features(1)->set_name("a");
  setting.options.set_joints("encoders");
  setting.options.add_joint_sd(-1);
  setting.options.add_joint_sd(1);
  EXPECT_THAT(Fields(setting.Status()),
              ElementsAre("options.joints", "options.joint_sd", "options.joint_sd",
                          "options.fixture.features[1].name"));
}

// Catches: one number in rad that is taken in m.
TEST(ReadingOptionFaults, OneDeviationForTwoTypesOfJoints) {
  Setting setting;
  setting.nominal.mutable_joints(2)->set_type(v1::PRISMATIC);
  setting.options.add_joint_sd(1e-4);
  EXPECT_THAT(Fields(setting.Status()), ElementsAre("options.joint_sd"));
}

TEST(NominalFaults, Masses) {
  v1::Nominal nominal = SampleNominal();
  v1::LinkMass* mass = nominal.add_masses();
  mass->set_joint(6);
  mass->set_mass_kg(-1);
  mass->set_z_m(NAN);
  EXPECT_THAT(Fields(ValidateNominal(nominal)),
              ElementsAre("masses[0].joint", "masses[0].mass_kg", "masses[0].z_m"));
  mass->set_joint(5);
  mass->set_mass_kg(3);
  mass->set_z_m(1);
  EXPECT_TRUE(ValidateNominal(nominal).ok());
}

// A value that is often right, and else one at or beyond a limit.
double Draw(std::mt19937& random, double usual) {
  const double values[] = {usual, usual, usual, usual, usual, usual, usual,    usual,
                           0,     1e4,   1.1e4, 1e6,   1.1e6, -1e9,  INFINITY, NAN};
  return values[random() % std::size(values)];
}

v1::Reading DrawReading(std::mt19937& random) {
  v1::Reading reading;
  reading.set_row(random() % 50 == 0 ? 7 : 0);
  const int joints = random() % 20 == 0 ? 5 : 6;
  for (int i = 0; i < joints; ++i) reading.add_joints_measured(Draw(random, 0.5));
  if (random() % 4 == 0) reading.add_joint_torques_nm(1);
  if (random() % 2 == 0) reading.mutable_position_m()->set_y(Draw(random, 1));
  if (random() % 2 == 0) {
    reading.mutable_orientation()->set_w(random() % 3 == 0 ? 1 + 1.5e-6 : 1);
    reading.mutable_orientation()->set_x(random() % 5 == 0 ? Draw(random, 0) : 0);
  }
  if (random() % 8 == 0) reading.mutable_axis()->set_z(random() % 2);
  if (random() % 8 == 0) reading.mutable_position_sd_m()->set_x(Draw(random, -1));
  if (random() % 8 == 0) reading.set_temperature_c(Draw(random, -300));
  if (random() % 8 == 0) reading.set_distance_m(Draw(random, -1));
  if (random() % 8 == 0) reading.set_coordinates("q");
  if (random() % 8 == 0) reading.add_points();
  return reading;
}

// Would catch a fault that the short check of uploads lets pass: what it says has to be what the
// whole check says, for faults of every field.
TEST(ReadingFaults, TheShortCheckSaysWhatTheWholeOneSays) {
  std::mt19937 random(1);
  int sound = 0;
  for (int i = 0; i < 20'000; ++i) {
    google::protobuf::RepeatedPtrField<v1::Reading> readings;
    *readings.Add() = DrawReading(random);
    const absl::Status whole =
        ValidateReadings(SampleNominal(), {readings.begin(), readings.end()}, 0);
    ASSERT_EQ(ValidateReadings(SampleNominal().joints_size(), readings, 0), whole)
        << readings[0].DebugString();
    sound += whole.ok();
  }
  EXPECT_GT(sound, 500) << "the draw is hardly ever without a fault";
}

}  // namespace
}  // namespace truepose::convert
