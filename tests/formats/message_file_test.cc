// Messages of the API from YAML and JSON, by descriptor.
#include "formats/message_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/base/fault.h"
#include "formats/message_text.h"
#include "truepose/v1/compensation_table_spec.pb.h"
#include "truepose/v1/plant.pb.h"
#include "truepose/v1/recalibration.pb.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> FieldsOf(const absl::Status& status) {
  std::vector<std::string> fields;
  for (const Fault& fault : FaultsOf(status)) fields.push_back(fault.field);
  return fields;
}

// Would catch a unit that is not converted, a kind of field that is left out, and a path that an
// update would apply elsewhere.
TEST(MessageFile, ReadsEachKindOfFieldAndTellsItsPath) {
  v1::RecalibrationPolicy policy;
  GivenFields given;
  ASSERT_TRUE(ParseMessageFile("interval: 86400s\ntemperature_step_k: 5\n"
                               "event_kinds: [COLLISION, MOTOR_CHANGE]\nposes: 40\n",
                               "p.yaml", policy, given)
                  .ok());
  EXPECT_EQ(policy.interval().seconds(), 86400);
  EXPECT_EQ(policy.temperature_step_k(), 5.0);
  EXPECT_EQ(policy.poses(), 40);
  EXPECT_THAT(policy.event_kinds(), ElementsAre(v1::COLLISION, v1::MOTOR_CHANGE));
  EXPECT_THAT(given.paths, ::testing::UnorderedElementsAre("interval", "temperature_step_k",
                                                           "event_kinds", "poses"));
  v1::Robot robot;
  given = {};
  ASSERT_TRUE(ParseMessageFile("limits: {drift_rms_mm: 0.3}", "r.yaml", robot, given).ok());
  EXPECT_EQ(robot.limits().drift_rms_mm(), 0.3) << "the field itself is in mm";
  EXPECT_THAT(given.paths, ElementsAre("limits.drift_rms_mm"));
}

// Would catch a pose of which an update changes half, or whose missing rotation is no rotation.
TEST(MessageFile, APoseIsOneField) {
  v1::Target target;
  GivenFields given;
  ASSERT_TRUE(ParseMessageFile("pose: {x_mm: 25, z_m: 0.08}", "t.yaml", target, given).ok());
  EXPECT_DOUBLE_EQ(target.pose().x_m(), 0.025);
  EXPECT_DOUBLE_EQ(target.pose().z_m(), 0.08);
  EXPECT_EQ(target.pose().qw(), 1.0);
  EXPECT_THAT(given.paths, ElementsAre("pose"));
}

// Would catch degrees stored as radians, and poses of a set that are dropped.
TEST(MessageFile, ListsOfMessagesAndAngles) {
  v1::PoseSet set;
  GivenFields given;
  ASSERT_TRUE(ParseMessageFile("poses:\n  - {joints: [0, 1.5], label: home}\n  - joints: [1, 2]\n",
                               "s.yaml", set, given)
                  .ok());
  ASSERT_EQ(set.poses_size(), 2);
  EXPECT_EQ(set.poses(0).label(), "home");
  EXPECT_THAT(set.poses(1).joints(), ElementsAre(1.0, 2.0));
  v1::Instrument instrument;
  ASSERT_TRUE(ParseMessageFile("rotation_sd_deg: 180", "i.yaml", instrument, given).ok());
  EXPECT_DOUBLE_EQ(instrument.rotation_sd_rad(), std::numbers::pi);
}

// Would catch faults one at a time, or without line.
TEST(MessageFile, NamesEveryFaultWithItsLine) {
  v1::Instrument instrument;
  GivenFields given;
  const absl::Status status = ParseMessageFile(
      "serial: [1]\nposition_sd_in: 1\nmodle: x\ncertificate_expire_time: soon\n"
      "position_sd_relative: much\n",
      "i.yaml", instrument, given);
  EXPECT_THAT(FieldsOf(status),
              ::testing::UnorderedElementsAre(
                  "i.yaml:1: serial", "i.yaml:2: position_sd_in", "i.yaml:3: 'modle'",
                  "i.yaml:4: certificate_expire_time", "i.yaml:5: position_sd_relative"));
  v1::PoseSet set;
  EXPECT_THAT(FieldsOf(ParseMessageFile("purpose: CALIBRATE", "s.yaml", set, given)),
              ElementsAre("s.yaml:1: purpose"));
}

// Would catch an empty value that is taken for "as it is" instead of "empty", and texts taken for
// YAML.
TEST(MessageFile, FieldsOneByOne) {
  v1::Robot robot;
  GivenFields given;
  ASSERT_TRUE(SetMessageFields({{"limits.drift_rms_mm", "0.3"},
                                {"limits.change_mm", "1"},
                                {"display_name", "Hall 3: left"},
                                {"release_policy", ""}},
                               "--set", robot, given)
                  .ok());
  EXPECT_EQ(robot.limits().change_mm(), 1.0);
  EXPECT_EQ(robot.display_name(), "Hall 3: left");
  EXPECT_THAT(given.paths,
              ::testing::UnorderedElementsAre("limits.drift_rms_mm", "limits.change_mm",
                                              "display_name", "release_policy"));
  EXPECT_THAT(FieldsOf(SetMessageFields({{"limits.drift_rms_mm", "x"}}, "--set", robot, given)),
              ElementsAre("--set limits.drift_rms_mm"));
}

// Would catch a whole number without a sign that ends the process, or is taken with one.
TEST(MessageFile, NumbersWithoutASign) {
  v1::CompensationTableSpec spec;
  GivenFields given;
  ASSERT_TRUE(ParseMessageFile("seed: 7\nbox:\n  cone_deg: 30\n", "s.yaml", spec, given).ok());
  EXPECT_EQ(spec.seed(), 7u);
  EXPECT_NEAR(spec.box().cone_rad(), 0.5235987755982988, 1e-15) << "rounding of 30 pi / 180";
  EXPECT_EQ(DescribeMessage(spec).back().text, "7");
  EXPECT_THAT(FieldsOf(ParseMessageFile("seed: -1", "s.yaml", spec, given)),
              ElementsAre("s.yaml:1: seed"));
}

// Would catch a field of which nobody knows in which unit it was written.
TEST(MessageFile, FieldsInSiUnitsAreToldApart) {
  v1::CompensationTableSpec spec;
  GivenFields given;
  ASSERT_TRUE(ParseMessageFile("box: {min_x_mm: 5, max_x_m: 1, cone_rad: 0.5, min_roll_deg: 3}\n"
                               "position_tolerance_m: 1e-5\nseed: 3",
                               "s.yaml", spec, given)
                  .ok());
  EXPECT_THAT(given.in_si, ::testing::UnorderedElementsAre("box.max_x_m", "box.cone_rad",
                                                           "position_tolerance_m"));
  given = {};
  ASSERT_TRUE(
      SetMessageFields({{"box.max_y_m", "1"}, {"box.max_z_mm", "1"}}, "--set", spec, given).ok());
  EXPECT_THAT(given.in_si, ElementsAre("box.max_y_m"));
}

// Would catch a text that can't be given back as it is shown, or in other units.
TEST(MessageText, ShowsWhatCanBeGiven) {
  v1::Instrument instrument;
  instrument.set_serial("4711");
  instrument.set_position_sd_m(2e-5);
  instrument.set_rotation_sd_rad(0.25);
  std::vector<std::pair<std::string, std::string>> shown;
  for (const FieldText& field : DescribeMessage(instrument))
    shown.emplace_back(field.key, field.text);
  ASSERT_EQ(shown.size(), 3u);
  EXPECT_EQ(shown[1].first, "position_sd_mm");
  EXPECT_EQ(shown[1].second, "0.02");
  v1::Instrument again;
  GivenFields given;
  ASSERT_TRUE(SetMessageFields(shown, "--set", again, given).ok());
  EXPECT_EQ(again.SerializeAsString(), instrument.SerializeAsString());
  EXPECT_THAT(SettableKeys(*v1::Target::descriptor(), {"name", "uid", "create_time", "update_time",
                                                       "delete_time", "revision", "etag"}),
              ElementsAre("display_name", "pose.x_mm", "pose.y_mm", "pose.z_mm", "pose.qx",
                          "pose.qy", "pose.qz", "pose.qw"));
}

}  // namespace
}  // namespace truepose::formats
