// A measured session without any instrument: a ball in two sockets, 50 mm apart, in six places.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "convert/readings.h"
#include "convert/robot.h"
#include "core/assessment/split.h"
#include "formats/fixture_file.h"
#include "formats/robot_file.h"
#include "formats/session_file.h"

namespace truepose::convert {
namespace {

std::string SharedFolder() {
  const char* folder = std::getenv("TRUEPOSE_SHARED");
  return folder == nullptr ? "../shared" : folder;
}

class Sockets : public ::testing::Test {
 protected:
  Sockets()
      : nominal_(formats::ReadRobotFile(TRUEPOSE_SOURCE_DIR "/deploy/examples/franka_panda.yaml")
                     ->nominal),
        robot_(*RobotFrom(nominal_)) {
    const auto file =
        formats::ReadSessionFile(SharedFolder() + "/data/mukca_panda/panda_3.csv", nominal_);
    EXPECT_TRUE(file.ok()) << file.status();
    *session_.mutable_session() = file->session;
    for (const v1::Reading& reading : file->readings) *session_.add_readings() = reading;
    options_.set_feature_column("hole");
    const auto fixture =
        formats::ReadFixtureFile(TRUEPOSE_SOURCE_DIR "/deploy/examples/sockets.yaml");
    EXPECT_TRUE(fixture.ok()) << fixture.status();
    *options_.mutable_fixture() = fixture->fixture;
  }

  v1::Nominal nominal_;
  Robot robot_;
  v1::SessionInput session_;
  v1::CalibrationOptions options_;
};

// Catches: contacts that are lost, or all in one socket, or in one place.
TEST_F(Sockets, EveryRowIsAContact) {
  const auto readings = ReadingsFrom(nominal_, robot_, {&session_}, options_);
  ASSERT_TRUE(readings.ok()) << readings.status();
  ASSERT_EQ(readings->problem.readings.size(), 387u);
  EXPECT_THAT(readings->problem.placements,
              ::testing::UnorderedElementsAre("backcenter", "backleft", "backright", "frontcenter",
                                              "frontleft", "frontright"));
  EXPECT_EQ(readings->problem.targets.size(), 1u);
  std::map<double, int> along;
  for (const Reading& reading : readings->problem.readings) {
    EXPECT_EQ(reading.kind, ObservationKind::kPoint);
    EXPECT_TRUE(reading.contact);
    EXPECT_TRUE(reading.covariance.has_value());
    ++along[reading.X_MT.p.x()];
  }
  EXPECT_THAT(along, ::testing::ElementsAre(::testing::Pair(0, 192), ::testing::Pair(0.05, 195)));
}

// 0.220 mm; other programs reach 0.211 to 0.216 on these rows (experiments, data), against the
// control rows' own mean at each socket, where ours are against the sockets of the fitted frame.
// Catches: sockets in each other's place (millimetres), a spacing of another size.
TEST_F(Sockets, CalibratesWithoutAnInstrument) {
  auto readings = ReadingsFrom(nominal_, robot_, {&session_}, options_);
  ASSERT_TRUE(readings.ok()) << readings.status();
  CalibrationProblem& problem = readings->problem;
  problem.robot = &robot_;
  problem.calibrates = *ApplySplit(*ParseSplit("even-odd"), 387, {}, {});
  const auto result = Calibrate(problem, {}, {});
  ASSERT_TRUE(result.ok()) << result.status();
  const double before = PoseStatisticsOf(result->control.before).position_m.rms;
  const double after = PoseStatisticsOf(result->control.after).position_m.rms;
  RecordProperty("before_um", static_cast<int>(before * 1e6));
  RecordProperty("after_um", static_cast<int>(after * 1e6));
  EXPECT_LT(after, 0.25e-3);
  EXPECT_GT(before, 4 * after);
}

}  // namespace
}  // namespace truepose::convert
