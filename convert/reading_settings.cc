#include "convert/reading_settings.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "convert/readings.h"
#include "core/base/fault.h"

namespace truepose::convert {
namespace {

using Sessions = std::vector<const v1::SessionInput*>;

constexpr size_t kNamesShown = 20;

std::string NamesOf(const FeaturePlaces& places) {
  std::vector<std::string> names;
  for (const auto& [name, place] : places) names.push_back(name);
  const size_t shown = std::min(names.size(), kNamesShown);
  return absl::StrCat("one of ",
                      absl::StrJoin(names.begin(), names.begin() + static_cast<long>(shown), ", "),
                      names.size() > shown ? ", ..." : "");
}

JointSource SourceFrom(const v1::CalibrationOptions& options, FaultList* faults) {
  const std::string& joints = options.joints();
  if (joints == "measured") return JointSource::kMeasured;
  if (joints == "commanded") return JointSource::kCommanded;
  if (!joints.empty() && joints != "both")
    faults->Add("options.joints", absl::StrCat("'", joints, "'"), "measured, commanded or both");
  return JointSource::kAny;
}

bool HasBothTypes(const Robot& robot) {
  const auto is_prismatic = [](const Joint& joint) { return joint.type == JointType::kPrismatic; };
  const auto& joints = robot.joints();
  return std::any_of(joints.begin(), joints.end(), is_prismatic) &&
         !std::all_of(joints.begin(), joints.end(), is_prismatic);
}

// Independent noise of the controller's joints, as the deviation of each chain joint.
Eigen::VectorXd JointDeviations(const Robot& robot, const v1::CalibrationOptions& options,
                                FaultList* faults) {
  const auto& sd = options.joint_sd();
  const int n = robot.joint_count();
  const bool one_for_all = sd.size() == 1 && !HasBothTypes(robot);
  const bool valid = std::all_of(sd.begin(), sd.end(),
                                 [](double value) { return value >= 0 && std::isfinite(value); });
  if (!valid) faults->Add("options.joint_sd", "a value that is no deviation", "0 or more");
  if (!sd.empty() && sd.size() != n && !one_for_all) {
    faults->Add("options.joint_sd", absl::StrCat(sd.size(), sd.size() == 1 ? " value" : " values"),
                absl::StrCat(n, ", one for each joint",
                             HasBothTypes(robot) ? ": some are in rad, some in m" : ", or one"));
    return {};
  }
  if (!valid || std::all_of(sd.begin(), sd.end(), [](double value) { return value == 0; }))
    return {};
  const Eigen::VectorXd controller =
      sd.size() == 1 ? Eigen::VectorXd(Eigen::VectorXd::Constant(n, sd[0]))
                     : Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(sd.data(), n));
  const Eigen::MatrixXd squares = robot.joint_map().scale.array().square();
  return (squares * controller.array().square().matrix()).cwiseSqrt();
}

// Each name once, at the first row that has it.
void CheckFeatures(const Sessions& sessions, const std::string& column,
                   const ReadingSettings& settings, FaultList* faults) {
  size_t row = 0;
  std::set<std::string> known;
  for (size_t s = 0; s < sessions.size(); ++s) {
    for (int k = 0; k < sessions[s]->readings_size(); ++k, ++row) {
      const std::string& name = settings.features[row];
      if (name.empty() || settings.places.count(name) > 0 || !known.insert(name).second) continue;
      faults->Add(absl::StrCat("sessions[", s, "].readings[", k, "].", column),
                  absl::StrCat("'", name, "'"), NamesOf(settings.places));
    }
  }
}

bool UsesFixture(const Sessions& sessions, const ReadingSettings& settings) {
  if (std::any_of(settings.features.begin(), settings.features.end(),
                  [](const std::string& name) { return !name.empty(); }))
    return true;
  for (const v1::SessionInput* session : sessions) {
    for (const v1::Reading& reading : session->readings()) {
      if (reading.has_distance_m() && settings.places.count(reading.anchor()) > 0) return true;
    }
  }
  return false;
}

void ReadFixture(const Sessions& sessions, const v1::CalibrationOptions& options,
                 ReadingSettings* settings, FaultList* faults) {
  const absl::Status valid = ValidateFixture(options.fixture());
  faults->AddAll(valid, "options.fixture.");
  const std::string column =
      options.feature_column().empty() ? "feature" : options.feature_column();
  auto features = ColumnValues(sessions, column, "options.feature_column");
  faults->AddAll(features.status());
  if (!valid.ok() || !features.ok()) return;
  settings->places = FeaturePlacesOf(options.fixture());
  settings->features = *std::move(features);
  CheckFeatures(sessions, column, *settings, faults);
  if (!UsesFixture(sessions, *settings)) {
    faults->Add("options.fixture", "no reading in any of its features",
                absl::StrCat("names of features in the column '", column, "', or anchors"));
  }
}

bool ShowsNothingElse(const v1::Reading& row) {
  return !row.has_position_m() && row.points().empty() && !row.has_distance_m();
}

void CheckNoFixture(const Sessions& sessions, const v1::CalibrationOptions& options,
                    FaultList* faults) {
  if (!options.feature_column().empty()) {
    faults->Add("options.feature_column",
                absl::StrCat("'", options.feature_column(), "' without a fixture"), "a fixture");
  }
  for (size_t s = 0; s < sessions.size(); ++s) {
    for (const v1::Reading& row : sessions[s]->readings()) {
      if (row.feature().empty() || !ShowsNothingElse(row)) continue;
      return faults->Add(absl::StrCat("sessions[", s, "].readings[", row.row(), "].feature"),
                         absl::StrCat("'", row.feature(), "' without a fixture"),
                         "the fixture that has it: --fixture FILE (options.fixture)");
    }
  }
}

}  // namespace

const FeaturePlace* ReadingSettings::FeatureOf(int row) const {
  if (features.empty()) return nullptr;
  const auto place = places.find(features[static_cast<size_t>(row)]);
  return place == places.end() ? nullptr : &place->second;
}

absl::StatusOr<ReadingSettings> ReadingSettingsFrom(const Robot& robot, const Sessions& sessions,
                                                    const v1::CalibrationOptions& options) {
  FaultList faults;
  ReadingSettings settings;
  settings.observe = options.observe();
  settings.joints = SourceFrom(options, &faults);
  settings.joint_sd = JointDeviations(robot, options, &faults);
  if (options.has_fixture()) {
    ReadFixture(sessions, options, &settings, &faults);
  } else {
    CheckNoFixture(sessions, options, &faults);
  }
  if (!faults.empty()) return faults.ToStatus();
  return settings;
}

}  // namespace truepose::convert
