// What is written reads back equal, to the bit.
#include <cmath>
#include <random>

#include "formats/fixture_file.h"
#include "gmock/gmock.h"
#include "google/protobuf/util/message_differencer.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::google::protobuf::util::MessageDifferencer;

void ExpectRoundTrip(const v1::Fixture& fixture) {
  const std::string text = WriteFixtureFile(fixture);
  const v1::Fixture again = ValueOf(ParseFixtureFile(text, "f.yaml")).fixture;
  EXPECT_TRUE(MessageDifferencer::Equals(again, fixture)) << text;
}

class RandomFixture {
 public:
  explicit RandomFixture(uint64_t seed) : random_(seed) {}

  v1::Fixture Make() {
    v1::Fixture fixture;
    fixture.set_name("f \"" + std::to_string(random_() % 10));
    const int n = 1 + static_cast<int>(random_() % 5);
    for (int i = 0; i < n; ++i) AddFeature(i, fixture.add_features());
    return fixture;
  }

 private:
  bool Coin() { return random_() % 2 == 0; }
  // Round in mm, or any bits at all.
  double Value() {
    if (Coin()) return (static_cast<int>(random_() % 2001) - 1000) / 1000.0;
    return std::uniform_real_distribution<double>(-4, 4)(random_);
  }

  void AddFeature(int i, v1::Feature* feature) {
    feature->set_name(std::to_string(i));
    feature->set_kind(static_cast<v1::FeatureKind>(1 + random_() % 4));
    v1::Pose* pose = feature->mutable_pose();
    pose->set_x_m(Value());
    pose->set_y_m(Value());
    pose->set_z_m(Value());
    const double half = feature->kind() == v1::FEATURE_POINT ? 0 : Value() / 4;
    pose->set_qy(std::sin(half));
    pose->set_qw(std::cos(half));
    if (Coin()) AddCovariance(feature);
  }

  void AddCovariance(v1::Feature* feature) {
    feature->mutable_covariance()->Resize(36, 0.0);
    const bool diagonal = Coin();
    for (int i = 0; i < 6; ++i) {
      const double sd = std::abs(Value()) * 1e-3;
      feature->set_covariance(7 * i, Coin() ? sd * sd : std::abs(Value()));
    }
    if (!diagonal) feature->set_covariance(1, Value());
    if (!diagonal) feature->set_covariance(6, feature->covariance(1));
  }

  std::mt19937_64 random_;
};

// Catches: digits lost, a field or kind that the writer forgets.
TEST(FixtureWriterTest, RandomFixturesReadBackToTheBit) {
  for (uint64_t seed = 0; seed < 500; ++seed) ExpectRoundTrip(RandomFixture(seed).Make());
}

// Catches: a file that people wrote in mm and that comes back in units that nobody reads.
TEST(FixtureWriterTest, KeepsTheUnitsOfPeople) {
  const std::string text =
      "name: sockets\nfeatures:\n"
      "  - {name: \"0\", kind: point, position_mm: [0, 0, 0], sd_mm: [0, 0, 0]}\n"
      "  - {name: a, kind: point_axis, position_mm: [50, 0.1, 0], qx: 0, qy: 0, qz: 0, qw: 1, "
      "sd_mm: [0.02, 0.03, 0.07], sd_deg: [0.1, 0.2, 0.3]}\n";
  EXPECT_EQ(WriteFixtureFile(ValueOf(ParseFixtureFile(text, "f.yaml")).fixture), text);
}

}  // namespace
}  // namespace truepose::formats
