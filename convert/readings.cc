#include "convert/readings.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "convert/observations.h"
#include "convert/reading_settings.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::convert {
namespace {

using Sessions = std::vector<const v1::SessionInput*>;

// Numbers labels in the order of their first appearance.
class Labels {
 public:
  int IndexOf(const std::string& key, const std::string& label) {
    const auto [it, added] = index_.emplace(key, static_cast<int>(labels_.size()));
    if (added) labels_.push_back(Unique(label));
    return it->second;
  }
  const std::vector<std::string>& labels() const { return labels_; }

 private:
  // A user's target may be called "session 1"; parameters are named after labels, and names are
  // unique.
  std::string Unique(std::string label) const {
    while (std::find(labels_.begin(), labels_.end(), label) != labels_.end()) label += "'";
    return label;
  }

  std::map<std::string, int> index_;
  std::vector<std::string> labels_;
};

// Rows named in a warning: enough to find them, not so many that they hide the rest.
std::string RowsText(const std::vector<int>& rows) {
  const size_t shown = std::min<size_t>(rows.size(), 20);
  return absl::StrCat("(rows ",
                      absl::StrJoin(rows.begin(), rows.begin() + static_cast<long>(shown), ", "),
                      rows.size() > shown ? ", ..." : "", ")");
}

// Of the rows that have one; 0 when none has.
double MeanTemperature(const v1::SessionInput& session) {
  double sum = 0;
  int rows = 0;
  for (const v1::Reading& reading : session.readings()) {
    if (!reading.has_temperature_c()) continue;
    sum += reading.temperature_c();
    ++rows;
  }
  return rows > 0 ? sum / rows : 0;
}

class Collector {
 public:
  Collector(const Robot& robot, const Sessions& sessions, const ReadingSettings& settings)
      : robot_(robot), sessions_(sessions), settings_(settings) {}

  ReadingsProblem Run() {
    for (size_t s = 0; s < sessions_.size(); ++s) {
      mean_temperature_ = MeanTemperature(*sessions_[s]);
      for (const v1::Reading& reading : sessions_[s]->readings())
        Take(static_cast<int>(s), reading);
      WarnOf(static_cast<int>(s));
    }
    result_.problem.placements = placements_.labels();
    result_.problem.targets = targets_.labels();
    result_.problem.offsets = beams_.labels();
    result_.joints_used = JointsUsed();
    return std::move(result_);
  }

 private:
  using Numbers = google::protobuf::RepeatedField<double>;

  const Numbers& JointsOf(const v1::Reading& row) const {
    const JointSource source = settings_.joints;
    const bool commanded = source == JointSource::kCommanded ||
                           (source == JointSource::kAny && row.joints_measured().empty());
    return commanded ? row.joints_commanded() : row.joints_measured();
  }

  // Commanded joints beside the measured ones that are used; none where one source is asked for.
  Eigen::VectorXd OtherJointsOf(const v1::Reading& row) const {
    if (settings_.joints != JointSource::kAny || row.joints_measured().empty() ||
        row.joints_commanded().empty())
      return {};
    return robot_.joint_map().ToChain(VectorOf(row.joints_commanded()));
  }

  static Eigen::VectorXd VectorOf(const Numbers& numbers) {
    return Eigen::Map<const Eigen::VectorXd>(numbers.data(), numbers.size());
  }

  void Take(int s, const v1::Reading& row) {
    const int position = all_rows_++;
    const FeaturePlace* feature = settings_.FeatureOf(position);
    const Numbers& joints = JointsOf(row);
    std::vector<Observation> observations =
        ObservationsOf(row, feature, settings_.places, settings_.observe);
    if (joints.empty() || observations.empty()) {
      unused_.push_back(row.row());
      return;
    }
    if (feature != nullptr && row.has_position_m()) not_taken_.push_back(row.row());
    (&joints == &row.joints_measured() ? measured_ : commanded_) += 1;
    for (Observation& observation : observations) {
      SetJoints(row, joints, &observation.reading);
      Place(s, row, observation, &observation.reading);
      Append(s, row.row(), position, std::move(observation.reading));
      result_.problem.other_q.push_back(OtherJointsOf(row));
    }
  }

  void SetJoints(const v1::Reading& row, const Numbers& joints, Reading* reading) const {
    reading->q = robot_.joint_map().ToChain(VectorOf(joints));
    reading->joint_sd = settings_.joint_sd;
    reading->conditions.joint_torque = VectorOf(row.joint_torques_nm());
    if (row.has_temperature_c())
      reading->conditions.temperature_K = row.temperature_c() - mean_temperature_;
  }

  // Placements, unknown anchors, beams and targets without a name belong to their session.
  void Place(int s, const v1::Reading& row, const Observation& observation, Reading* reading) {
    const std::string session = absl::StrCat(s, "\n");
    std::string key = absl::StrCat(session, row.placement()), label = row.placement();
    if (!observation.anchor.empty()) {
      absl::StrAppend(&key, "\n", observation.anchor);
      label = Joined(label, observation.anchor);
    }
    reading->placement = placements_.IndexOf(key, Label(s, label));
    const std::string target = Joined(row.target(), observation.point);
    const bool named = !row.target().empty();
    reading->target = targets_.IndexOf(named ? target : absl::StrCat(session, target),
                                       named ? target : Label(s, target));
    if (!observation.beam.empty())
      reading->offset = beams_.IndexOf(session + observation.beam, Label(s, observation.beam));
  }

  void Append(int s, int row, int position, Reading reading) {
    reading.id = static_cast<int>(result_.rows.size());
    reading.row = position;
    result_.problem.readings.push_back(std::move(reading));
    result_.rows.push_back({s, row});
    result_.position.push_back(position);
  }

  static std::string Joined(const std::string& a, const std::string& b) {
    return a.empty() || b.empty() ? a + b : absl::StrCat(a, "/", b);
  }

  std::string Label(int s, const std::string& label) const {
    if (sessions_.size() == 1) return label;
    return Joined(absl::StrCat("session ", s + 1), label);
  }

  void WarnOf(int s) {
    Warn(s, " rows are not used: joints or the observed quantity are missing ", &unused_);
    Warn(s, " rows stand in a feature: their measured positions are not used ", &not_taken_);
  }

  void Warn(int s, const std::string& what, std::vector<int>* rows) {
    if (rows->empty()) return;
    result_.warnings.push_back(absl::StrCat(Label(s, ""), sessions_.size() > 1 ? ": " : "",
                                            rows->size(), what, RowsText(*rows)));
    rows->clear();
  }

  std::string JointsUsed() const {
    if (commanded_ == 0) return "measured";
    if (measured_ == 0) return "commanded";
    return absl::StrCat("measured (", measured_, " rows), commanded (", commanded_, " rows)");
  }

  const Robot& robot_;
  const Sessions& sessions_;
  const ReadingSettings& settings_;
  ReadingsProblem result_;
  Labels placements_, targets_, beams_;
  std::vector<int> unused_, not_taken_;
  double mean_temperature_ = 0;
  int all_rows_ = 0, measured_ = 0, commanded_ = 0;
};

// Rows that count twice make every deviation too small by the root of two.
void CheckRepeatedSessions(const Sessions& sessions, FaultList* faults) {
  if (sessions.size() < 2) return;
  std::map<std::string, size_t> first;
  for (size_t s = 0; s < sessions.size(); ++s) {
    const auto& readings = sessions[s]->readings();
    const auto [it, added] = first.emplace(ReadingsDigest({readings.begin(), readings.end()}), s);
    if (!added) {
      faults->Add(absl::StrCat("sessions[", s, "]"),
                  absl::StrCat("the same readings as sessions[", it->second, "]"),
                  "each session once");
    }
  }
}

absl::Status CheckSessions(const v1::Nominal& nominal, const Sessions& sessions) {
  FaultList faults;
  if (sessions.empty()) faults.Add("sessions", "none", "at least one sealed session");
  for (size_t s = 0; s < sessions.size(); ++s) {
    const auto& readings = sessions[s]->readings();
    faults.AddAll(ValidateReadings(nominal, {readings.begin(), readings.end()}, 0),
                  absl::StrCat("sessions[", s, "]."));
  }
  CheckRepeatedSessions(sessions, &faults);
  return faults.ToStatus();
}

}  // namespace

absl::StatusOr<ReadingsProblem> ReadingsFrom(const v1::Nominal& nominal, const Robot& robot,
                                             const Sessions& sessions,
                                             const v1::CalibrationOptions& options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckSessions(nominal, sessions));
  TRUEPOSE_ASSIGN_OR_RETURN(const ReadingSettings settings,
                            ReadingSettingsFrom(robot, sessions, options));
  return Collector(robot, sessions, settings).Run();
}

absl::StatusOr<ReadingsProblem> ReadingsFrom(const v1::Nominal& nominal, const Robot& robot,
                                             const Sessions& sessions, v1::Observe observe) {
  v1::CalibrationOptions options;
  options.set_observe(observe);
  return ReadingsFrom(nominal, robot, sessions, options);
}

}  // namespace truepose::convert
