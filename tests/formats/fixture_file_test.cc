// What a fixture file means, and every fault of one, word by word.
#include "formats/fixture_file.h"

#include <cmath>
#include <numbers>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> FaultsIn(const std::string& features) {
  return Faults(ParseFixtureFile("name: f\nfeatures:\n" + features, "f.yaml"));
}

v1::Feature FeatureOf(const std::string& feature) {
  const FixtureFile file =
      ValueOf(ParseFixtureFile("name: f\nfeatures:\n  - " + feature + "\n", "f.yaml"));
  return file.fixture.features_size() == 1 ? file.fixture.features(0) : v1::Feature();
}

double Turn(const v1::Feature& feature) {
  const v1::Pose& pose = feature.pose();
  return 2 * std::atan2(std::hypot(pose.qx(), pose.qy(), pose.qz()), pose.qw());
}

TEST(FixtureFileTest, ReadsKindsPlacesAndNames) {
  const FixtureFile file = ValueOf(ParseFixtureFile(
      "name: dime 3\nfeatures:\n"
      "  - {name: 0, kind: point, position_mm: [1, 2, 3]}\n"
      "  - {name: a b, kind: pose, position_m: [1, 2, 3], qx: 0, qy: 0, qz: -0.6, qw: -0.8}\n"
      "  - {name: c, kind: point_axis, position_mm: [0, 0, 0], axis: [0, 1, 0]}\n"
      "  - {name: d, kind: plane, position_mm: [0, 0, 40]}\n",
      "folder/f.yaml"));
  ASSERT_EQ(file.fixture.features_size(), 4);
  EXPECT_EQ(file.fixture.name(), "dime 3");
  EXPECT_EQ(file.fixture.features(0).name(), "0");
  EXPECT_EQ(file.fixture.features(0).kind(), v1::FEATURE_POINT);
  EXPECT_EQ(file.fixture.features(0).pose().y_m(), 0.002);
  EXPECT_EQ(file.fixture.features(0).pose().qw(), 1);
  EXPECT_THAT(file.fixture.features(0).covariance(), IsEmpty());
  EXPECT_EQ(file.fixture.features(1).pose().z_m(), 3);
  // One sign of the two, as the message asks for.
  EXPECT_EQ(file.fixture.features(1).pose().qw(), 0.8);
  EXPECT_EQ(file.fixture.features(1).pose().qz(), 0.6);
  EXPECT_EQ(file.fixture.features(2).kind(), v1::FEATURE_POINT_AXIS);
  EXPECT_EQ(file.fixture.features(3).kind(), v1::FEATURE_PLANE);
  EXPECT_EQ(file.lines.LineOf("features[2].pose"), 5);
}

// Catches: angles in the wrong order or about the wrong axes. R(z, 90 deg) R(x, 90 deg) carries y
// to z and z to x: a turn by 120 deg about (1, 1, 1).
TEST(FixtureFileTest, RollPitchYawAreAboutFixedAxes) {
  const v1::Feature feature =
      FeatureOf("{name: a, kind: pose, position_mm: [0, 0, 0], rpy_deg: [90, 0, 90]}");
  for (const double q :
       {feature.pose().qx(), feature.pose().qy(), feature.pose().qz(), feature.pose().qw()}) {
    EXPECT_NEAR(q, 0.5, 1e-15);  // rounding of a product of unit quaternions
  }
  const v1::Feature rad =
      FeatureOf("{name: a, kind: pose, position_mm: [0, 0, 0], rpy_rad: [0, -0.5, 0]}");
  EXPECT_NEAR(rad.pose().qy(), -std::sin(0.25), 1e-15);
}

// Catches: a turn that carries z elsewhere, a division by zero for the axis that is opposite to z.
TEST(FixtureFileTest, AnAxisIsTheLeastTurnOfZ) {
  const auto with_axis = [](const std::string& axis) {
    return FeatureOf("{name: a, kind: point_axis, position_mm: [0, 0, 0], axis: " + axis + "}");
  };
  const v1::Feature along_x = with_axis("[1, 0, 0]");
  EXPECT_NEAR(along_x.pose().qy(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(Turn(along_x), std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(Turn(with_axis("[0, 0, -1]")), std::numbers::pi, 1e-15);
  EXPECT_EQ(Turn(with_axis("[0, 0, 1]")), 0);
}

// Catches: a deviation that is taken for a variance, millimetres beside radians, rows for columns.
TEST(FixtureFileTest, ReadsUncertainty) {
  const v1::Feature sd =
      FeatureOf("{name: a, kind: pose, position_mm: [0, 0, 0], sd_mm: [1, 2, 0], sd_deg: 18}");
  ASSERT_EQ(sd.covariance_size(), 36);
  EXPECT_EQ(sd.covariance(7), 0.002 * 0.002);
  EXPECT_EQ(sd.covariance(14), 0);
  const double angle = std::numbers::pi / 10;
  EXPECT_NEAR(sd.covariance(35), angle * angle, 1e-16);  // last bits of deg to rad
  EXPECT_EQ(sd.covariance(1), 0);
  const v1::Feature full = FeatureOf(
      "{name: a, kind: pose, position_mm: [0, 0, 0], covariance_mm_deg: "
      "[[1, 0, 0, 0, 0, 3], [0, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0],"
      " [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [3, 0, 0, 0, 0, 9]]}");
  ASSERT_EQ(full.covariance_size(), 36);
  const double degree = std::numbers::pi / 180;
  EXPECT_NEAR(full.covariance(0), 1e-6, 1e-21);           // 15 digits
  EXPECT_NEAR(full.covariance(5), 3e-3 * degree, 1e-18);  // likewise
  EXPECT_NEAR(full.covariance(35), 9 * degree * degree, 1e-16);
}

TEST(FixtureFileTest, NamesWhatIsMissingOrUnknown) {
  EXPECT_THAT(Faults(ParseFixtureFile("feature: []\n", "f.yaml")),
              ElementsAre("f.yaml:1: name: found no such key, expected one",
                          "f.yaml:1: features: found no such key, expected one",
                          "f.yaml:1: 'feature': found an unknown key, expected features"));
  EXPECT_THAT(FaultsIn("  []\n"),
              ElementsAre("f.yaml:2: features: found an empty list, expected at least one "
                          "feature"));
  EXPECT_THAT(
      FaultsIn("  - {nam: a}\n  - 3\n"),
      ElementsAre("f.yaml:3: features[0].name: found no such key, expected one",
                  "f.yaml:3: features[0].kind: found no such key, expected one",
                  "f.yaml:3: features[0].position_mm: found no such key, expected position_mm or "
                  "position_m",
                  "f.yaml:3: features[0].'nam': found an unknown key, expected name",
                  "f.yaml:4: features[1]: found '3', expected a map of `key: value`"));
  EXPECT_THAT(
      FaultsIn("  - {name: a, kind: hole, position: [1, 2, 3]}\n"
               "  - {name: a, kind: point, position_mm: [1, x]}\n"),
      ElementsAre("f.yaml:3: features[0].kind: found 'hole', expected pose, point, point_axis or "
                  "plane",
                  "f.yaml:3: features[0].position: found the key 'position', expected position_mm "
                  "or position_m",
                  "f.yaml:4: features[1].position_mm[1]: found 'x', expected a number",
                  "f.yaml:4: features[1].position_mm: found 2 numbers, expected 3, x, y, z",
                  "f.yaml:4: features[1].name: found 'a' a second time, expected a name other than "
                  "that of features[0]"));
}

// Catches: the second of two orientations that is dropped, an orientation that says nothing.
TEST(FixtureFileTest, NamesWrongOrientations) {
  const auto faults = [](const std::string& kind, const std::string& orientation) {
    return FaultsIn("  - {name: a, position_mm: [0, 0, 0], kind: " + kind + ", " + orientation +
                    "}\n");
  };
  EXPECT_THAT(faults("pose", "rpy_deg: [0, 0, 0], qx: 0, qy: 0, qz: 0, qw: 1"),
              ElementsAre("f.yaml:3: features[0]: found several orientations, expected one of qx, "
                          "qy, qz, qw, of rpy_deg and of axis"));
  EXPECT_THAT(faults("pose", "axis: [0, 0, 1]"),
              ElementsAre("f.yaml:3: features[0].axis: found an axis alone, expected qx, qy, qz, "
                          "qw or rpy_deg: a pose does not turn freely"));
  EXPECT_THAT(faults("point", "axis: [0, 0, 1]"),
              ElementsAre("f.yaml:3: features[0]: found an orientation, expected none: a point has "
                          "none"));
  EXPECT_THAT(faults("plane", "axis: [0, 0, 2]"),
              ElementsAre("f.yaml:3: features[0].axis: found a length of 2, expected 1 within "
                          "0.001"));
  EXPECT_THAT(faults("pose", "rpy: [0, 0, 0]"),
              ElementsAre("f.yaml:3: features[0].rpy: found the key 'rpy', expected rpy_deg or "
                          "rpy_rad"));
  EXPECT_THAT(faults("pose", "rpy_deg: 3"),
              ElementsAre("f.yaml:3: features[0].rpy_deg: found '3', expected a list"));
  EXPECT_THAT(faults("pose", "qx: 1"),
              ElementsAre("f.yaml:3: features[0]: found 1 of qx, qy, qz, qw, expected all four or "
                          "none"));
}

TEST(FixtureFileTest, NamesWrongUncertainty) {
  const auto faults = [](const std::string& kind, const std::string& uncertainty) {
    return FaultsIn("  - {name: a, position_mm: [0, 0, 0], kind: " + kind + ", " + uncertainty +
                    "}\n");
  };
  EXPECT_THAT(faults("point", "sd_mm: -1, sd: 3"),
              ElementsAre("f.yaml:3: features[0].sd: found the key 'sd', expected sd_mm or sd_m"));
  EXPECT_THAT(faults("point", "sd_mm: [1, -2, 3]"),
              ElementsAre("f.yaml:3: features[0].sd_mm: found -2, expected a standard deviation, "
                          "at least 0"));
  EXPECT_THAT(faults("point", "sd_mm: [1, 2]"),
              ElementsAre("f.yaml:3: features[0].sd_mm: found 2 numbers, expected 3, one along "
                          "each axis"));
  EXPECT_THAT(faults("plane", "sd_deg: 1"),
              ElementsAre("f.yaml:3: features[0]: found a deviation of an angle, expected sd_mm "
                          "only: of a point or plane a length is observed"));
  EXPECT_THAT(faults("pose", "sd_mm: 1, covariance_m_rad: [[1, 2], 3]"),
              ElementsAre("f.yaml:3: features[0].covariance_m_rad: found a covariance beside "
                          "sd_mm or sd_deg, expected one of them",
                          "f.yaml:3: features[0].covariance_m_rad: found 2 rows, expected 6: x, y, "
                          "z and the turns about them",
                          "f.yaml:3: features[0].covariance_m_rad[0]: found 2 numbers, expected 6, "
                          "as many as rows",
                          "f.yaml:3: features[0].covariance_m_rad[1]: found '3', expected a list"));
}

TEST(FixtureFileTest, NamesAFileThatIsNotThere) {
  EXPECT_EQ(ReadFixtureFile("no/such.yaml").status().code(), absl::StatusCode::kNotFound);
}

}  // namespace
}  // namespace truepose::formats
