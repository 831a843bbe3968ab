// What the options of a calibration say of its readings, checked against robot and sessions.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "convert/fixture.h"
#include "core/robot/robot.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::convert {

enum class JointSource { kAny, kMeasured, kCommanded };

struct ReadingSettings {
  v1::Observe observe = v1::OBSERVE_UNSPECIFIED;
  JointSource joints = JointSource::kAny;
  Eigen::VectorXd joint_sd;           // of chain joints; empty where none is stated
  FeaturePlaces places;               // of the fixture; empty without one
  std::vector<std::string> features;  // of each row of all sessions, "" none; empty without fixture

  // The feature in which the tool stands in a row, nullptr for none.
  const FeaturePlace* FeatureOf(int row) const;
};

// @returns kInvalidArgument with all faults, fields `options...` and `sessions[i].readings[k]...`:
// a fixture that is none or that no reading uses, a column of features without a fixture or that a
// session does not have, a feature that the fixture does not have, readings in features without a
// fixture, deviations of joints in the wrong number, joints that are neither measured, commanded
// nor both.
absl::StatusOr<ReadingSettings> ReadingSettingsFrom(
    const Robot& robot, const std::vector<const v1::SessionInput*>& sessions,
    const v1::CalibrationOptions& options);

}  // namespace truepose::convert
