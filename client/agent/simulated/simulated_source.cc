#include "client/agent/simulated/simulated_source.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/agent/sources/session_feed.h"
#include "convert/frames.h"
#include "core/base/random.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

constexpr int kDrawnTargets = 40;
constexpr double kSwingHz = 3.0, kSwingDecay_s = 0.2;
// The cell's time 0; a simulation has no date of its own.
const absl::Time kStart = absl::FromUnixSeconds(1767225600);  // 2026-01-01

using Joints = std::vector<double>;

Eigen::VectorXd Vector(const Joints& joints) {
  return Eigen::Map<const Eigen::VectorXd>(joints.data(), static_cast<Eigen::Index>(joints.size()));
}

Joints MiddleOf(const Robot& robot) {
  const Eigen::VectorXd middle = robot.MiddleOfLimits();
  return {middle.begin(), middle.end()};
}

// Spread as simulated sessions are, within the limits.
std::vector<Joints> DrawTargets(const Robot& robot) {
  Random random(1);
  std::vector<Joints> targets(kDrawnTargets, MiddleOf(robot));
  for (Joints& target : targets) {
    for (size_t j = 0; j < target.size(); ++j) {
      const Joint& joint = robot.joints()[j];
      const double range = joint.type == JointType::kRevolute ? 1.5 : 0.3;
      target[j] = random.Uniform(std::max(joint.lower, target[j] - range),
                                 std::min(joint.upper, target[j] + range));
    }
  }
  return targets;
}

// The sink's refusals of a simulation's readings are all of the session.
void Ignore(const Fault&) {}

}  // namespace

std::vector<double> JointsOnTheWay(const Joints& from, const Joints& to, double t_s,
                                   const SimulatedOptions& options) {
  const double share = options.move_s > 0 ? std::clamp(t_s / options.move_s, 0.0, 1.0) : 1.0;
  const double eased = 0.5 - 0.5 * std::cos(std::numbers::pi * share);
  const double still_s = std::max(t_s - options.move_s, 0.0);
  const double swing = share < 1.0 ? 0.0
                                   : options.swing * std::exp(-still_s / kSwingDecay_s) *
                                         std::cos(2 * std::numbers::pi * kSwingHz * still_s);
  Joints joints(to.size());
  for (size_t j = 0; j < to.size(); ++j) joints[j] = from[j] + eased * (to[j] - from[j]) + swing;
  return joints;
}

SimulatedSource::SimulatedSource(std::shared_ptr<const Cell> cell, SimulatedOptions options,
                                 std::function<double()> clock)
    : cell_(std::move(cell)),
      options_(std::move(options)),
      clock_(std::move(clock)),
      at_(MiddleOf(cell_->robot())) {}

std::string SimulatedSource::name() const {
  const std::string label = options_.label.empty() ? "" : " " + options_.label;
  return absl::StrCat("simulated ", options_.robot, label);
}

absl::Time SimulatedSource::TimeNow() const { return kStart + absl::Seconds(Now()); }

absl::Status SimulatedSource::Run(ReadingSink& sink, const Stop& stop) {
  if (options_.for_requests) return AnswerRequests(sink, stop);
  SessionStart start;
  start.key = name();
  const absl::Status status = MeasureSession(
      sink, stop, start, options_.targets.empty() ? DrawTargets(cell_->robot()) : options_.targets);
  return status.code() == absl::StatusCode::kCancelled ? absl::OkStatus() : status;
}

absl::Status SimulatedSource::AnswerRequests(ReadingSink& sink, const Stop& stop) {
  while (!stop.WaitFor(options_.poll)) {
    const absl::StatusOr<MeasuringTask> task = sink.Task(options_.robot);
    if (task.status().code() == absl::StatusCode::kNotFound) continue;
    TRUEPOSE_RETURN_IF_ERROR(task.status());
    std::vector<Joints> targets;
    for (const v1::PoseSetPose& pose : task->poses)
      targets.push_back({pose.joints().begin(), pose.joints().end()});
    if (targets.empty()) targets = DrawTargets(cell_->robot());
    SessionStart start;
    start.for_request = true;
    const absl::Status status = MeasureSession(sink, stop, start, targets);
    if (status.code() == absl::StatusCode::kCancelled) break;
    TRUEPOSE_RETURN_IF_ERROR(status);
  }
  return absl::OkStatus();
}

absl::Status SimulatedSource::MeasureSession(ReadingSink& sink, const Stop& stop,
                                             const SessionStart& wanted,
                                             const std::vector<Joints>& targets) {
  SessionStart start = wanted;
  start.content = options_.content;
  start.content.set_robot(options_.robot);
  const FaultReport ignore = Ignore;
  SessionFeed feed(sink, stop, name(), ignore);
  TRUEPOSE_RETURN_IF_ERROR(feed.Begin(start));
  if (feed.was_sealed()) return absl::OkStatus();
  for (size_t i = static_cast<size_t>(feed.GoOn()); i < targets.size(); ++i) {
    TRUEPOSE_ASSIGN_OR_RETURN(v1::Reading reading, DriveTo(targets[i], i + 1, stop));
    TRUEPOSE_RETURN_IF_ERROR(feed.Add(std::move(reading), static_cast<int64_t>(i + 1)));
    TRUEPOSE_RETURN_IF_ERROR(feed.Flush());
  }
  return feed.Seal();
}

absl::StatusOr<v1::Reading> SimulatedSource::DriveTo(const Joints& target, uint64_t number,
                                                     const Stop& stop) {
  if (target.size() != at_.size()) {
    return absl::InvalidArgumentError(
        absl::StrCat("target ", number, " has ", target.size(), " joints, the robot ", at_.size()));
  }
  Settled settled(options_.settle);
  const Joints from = at_;
  const double end_s = options_.move_s + options_.still_s;
  for (double t_s = 0; t_s <= end_s; t_s += options_.sample_s) {
    const auto wait = std::chrono::milliseconds(
        options_.speed > 0 ? std::lround(1e3 * options_.sample_s / options_.speed) : 0);
    if (stop.WaitFor(wait)) return absl::CancelledError("stopped");
    elapsed_s_ += options_.sample_s;
    at_ = JointsOnTheWay(from, target, t_s, options_);
    v1::Reading reading = ReadingAt(at_, target, number);
    if (settled.Add(reading, kStart + absl::Seconds(elapsed_s_))) return reading;
  }
  return absl::FailedPreconditionError(
      absl::StrCat("the robot does not come to rest within ", options_.still_s, " s"));
}

v1::Reading SimulatedSource::ReadingAt(const Joints& read, const Joints& target,
                                       uint64_t number) const {
  v1::Reading reading;
  reading.mutable_joints_measured()->Add(read.begin(), read.end());
  reading.mutable_joints_commanded()->Add(target.begin(), target.end());
  const Pose X_MT = cell_->Measure(Vector(read), Now(), options_.noise_from + number);
  *reading.mutable_position_m() = convert::ToProto(X_MT.p);
  *reading.mutable_orientation() = convert::QuaternionToProto(X_MT.R);
  reading.set_time(absl::FormatTime(absl::RFC3339_full, TimeNow(), absl::UTCTimeZone()));
  return reading;
}

}  // namespace truepose::agent
