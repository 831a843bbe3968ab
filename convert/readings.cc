#include "convert/readings.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "convert/frames.h"
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

std::optional<ObservationKind> KindFor(const v1::Reading& reading, v1::Observe observe) {
  if (!reading.has_position_m()) return std::nullopt;
  const bool axis = reading.has_axis() || reading.has_orientation();
  switch (observe) {
    case v1::POSE:
      return reading.has_orientation() ? std::optional(ObservationKind::kPose) : std::nullopt;
    case v1::POINT_AXIS:
      return axis ? std::optional(ObservationKind::kPointAxis) : std::nullopt;
    case v1::POINT:
      return ObservationKind::kPoint;
    default:
      break;
  }
  if (reading.has_orientation()) return ObservationKind::kPose;
  return reading.has_axis() ? ObservationKind::kPointAxis : ObservationKind::kPoint;
}

Reading ReadingFrom(const v1::Reading& message, const Robot& robot, ObservationKind kind) {
  const auto& joints =
      message.joints_measured_size() > 0 ? message.joints_measured() : message.joints_commanded();
  Reading reading;
  reading.q =
      robot.joint_map().ToChain(Eigen::Map<const Eigen::VectorXd>(joints.data(), joints.size()));
  reading.kind = kind;
  reading.X_MT.p = VectorFrom(message.position_m());
  if (message.has_orientation()) {
    reading.X_MT.R = RotationFrom(message.orientation());
    reading.axis_M = reading.X_MT.R.col(2);
  }
  if (message.has_axis()) reading.axis_M = VectorFrom(message.axis()).normalized();
  if (message.has_position_sd_m()) reading.position_sd_m = VectorFrom(message.position_sd_m());
  return reading;
}

class Collector {
 public:
  Collector(const Robot& robot, const Sessions& sessions, v1::Observe observe)
      : robot_(robot), sessions_(sessions), observe_(observe) {}

  ReadingsProblem Run() {
    for (size_t s = 0; s < sessions_.size(); ++s) {
      for (const v1::Reading& reading : sessions_[s]->readings())
        Take(static_cast<int>(s), reading);
      WarnOfUnused(static_cast<int>(s));
    }
    result_.problem.placements = placements_.labels();
    result_.problem.targets = targets_.labels();
    result_.joints_used = JointsUsed();
    return std::move(result_);
  }

 private:
  void Take(int s, const v1::Reading& message) {
    const int position = all_rows_++;
    const bool has_joints = message.joints_measured_size() + message.joints_commanded_size() > 0;
    const auto kind = KindFor(message, observe_);
    if (!has_joints || !kind.has_value()) {
      unused_.push_back(message.row());
      return;
    }
    Reading reading = ReadingFrom(message, robot_, *kind);
    reading.id = static_cast<int>(result_.rows.size());
    reading.placement = placements_.IndexOf(absl::StrCat(s, "\n", message.placement()),
                                            Label(s, message.placement()));
    const std::string& target = message.target();
    reading.target = targets_.IndexOf(target.empty() ? absl::StrCat(s, "\n") : target,
                                      target.empty() ? Label(s, "") : target);
    (message.joints_measured_size() > 0 ? measured_ : commanded_) += 1;
    result_.problem.readings.push_back(std::move(reading));
    result_.rows.push_back({s, message.row()});
    result_.position.push_back(position);
  }

  std::string Label(int s, const std::string& label) const {
    if (sessions_.size() == 1) return label;
    const std::string session = absl::StrCat("session ", s + 1);
    return label.empty() ? session : absl::StrCat(session, "/", label);
  }

  void WarnOfUnused(int s) {
    if (unused_.empty()) return;
    const size_t shown = std::min<size_t>(unused_.size(), 20);
    const std::string rows =
        absl::StrJoin(unused_.begin(), unused_.begin() + static_cast<long>(shown), ", ");
    result_.warnings.push_back(
        absl::StrCat(Label(s, ""), sessions_.size() > 1 ? ": " : "", unused_.size(),
                     " rows are not used: joints or the observed quantity are missing (rows ", rows,
                     unused_.size() > shown ? ", ..." : "", ")"));
    unused_.clear();
  }

  std::string JointsUsed() const {
    if (commanded_ == 0) return "measured";
    if (measured_ == 0) return "commanded";
    return absl::StrCat("measured (", measured_, " rows), commanded (", commanded_, " rows)");
  }

  const Robot& robot_;
  const Sessions& sessions_;
  const v1::Observe observe_;
  ReadingsProblem result_;
  Labels placements_, targets_;
  std::vector<int> unused_;
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

const std::string* BuiltInColumn(const v1::Reading& reading, const std::string& column) {
  if (column == "placement") return &reading.placement();
  if (column == "target") return &reading.target();
  if (column == "group") return &reading.group();
  if (column == "time") return &reading.time();
  return nullptr;
}

absl::Status UnknownColumn(const v1::Session& session, const std::string& column,
                           const std::string& field) {
  std::vector<std::string> names = {"placement", "target", "group", "time"};
  names.insert(names.end(), session.extra_columns().begin(), session.extra_columns().end());
  return FaultStatus(field, absl::StrCat("column '", column, "'"),
                     absl::StrCat("one of ", absl::StrJoin(names, ", ")));
}

}  // namespace

absl::StatusOr<ReadingsProblem> ReadingsFrom(const v1::Nominal& nominal, const Robot& robot,
                                             const Sessions& sessions, v1::Observe observe) {
  TRUEPOSE_RETURN_IF_ERROR(CheckSessions(nominal, sessions));
  return Collector(robot, sessions, observe).Run();
}

absl::StatusOr<std::vector<std::string>> ColumnValues(const Sessions& sessions,
                                                      const std::string& column,
                                                      const std::string& field) {
  std::vector<std::string> values;
  for (const v1::SessionInput* session : sessions) {
    const auto& extra = session->session().extra_columns();
    const auto it = std::find(extra.begin(), extra.end(), column);
    const int index = static_cast<int>(it - extra.begin());
    for (const v1::Reading& reading : session->readings()) {
      if (const std::string* value = BuiltInColumn(reading, column)) {
        values.push_back(*value);
      } else if (it != extra.end() && index < reading.extra_values_size()) {
        values.push_back(reading.extra_values(index));
      } else {
        return UnknownColumn(session->session(), column, field);
      }
    }
  }
  return values;
}

}  // namespace truepose::convert
