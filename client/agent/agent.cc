#include "client/agent/agent.h"

#include <chrono>

#include "absl/strings/str_cat.h"
#include "client/agent/lines/status_json.h"
#include "client/agent/log.h"
#include "client/token_file.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

constexpr std::chrono::seconds kReportInterval{60};

// One connection's conversation as what the server of lines wants.
class ConversationHandler : public LineHandler {
 public:
  explicit ConversationHandler(const Desk& desk) : conversation_(desk) {}
  std::string Answer(const std::vector<std::string>& lines) override {
    return conversation_.Answer(lines);
  }
  std::string AnswerTooLong(size_t most) override { return conversation_.AnswerTooLong(most); }

 private:
  Conversation conversation_;
};

double UnixTime() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

IntakeOptions IntakeOptionsOf(const AgentConfig& config) {
  IntakeOptions options{.agent = config.agent, .joints = {}};
  for (const RobotSettings& robot : config.robots) options.joints[robot.name] = robot.joints;
  return options;
}

std::vector<std::string> RobotNames(const AgentConfig& config) {
  std::vector<std::string> names;
  for (const RobotSettings& robot : config.robots) names.push_back(robot.name);
  return names;
}

void LogLine(const std::string& line) { LogInfo(line); }
void WarnLine(const std::string& line) { LogWarning(line); }

void AddReleased(const ReleasedState& state, RobotStatus* status) {
  status->released_problem = state.problem;
  status->controller_state = state.controller_state;
  if (state.current == nullptr) return;
  status->released = state.current->entry().calibration;
  status->released_digest = state.current->entry().calibration_digest;
}

}  // namespace

Agent::Agent(const AgentConfig& config, client::Client client)
    : config_(config), client_(std::move(client)) {
  for (const RobotSettings& robot : config_.robots) {
    RobotStatus& status = robots_[robot.name];
    status.robot = robot.name;
    status.joints = robot.joints;
  }
}

absl::StatusOr<std::unique_ptr<Agent>> Agent::Start(const AgentConfig& config,
                                                    std::vector<std::unique_ptr<Source>> sources) {
  client::ClientOptions options;
  TRUEPOSE_ASSIGN_OR_RETURN(options.token, client::FindToken(config.token_file));
  TRUEPOSE_ASSIGN_OR_RETURN(client::Client client, client::Client::Connect(config.server, options));
  std::unique_ptr<Agent> agent(new Agent(config, std::move(client)));
  TRUEPOSE_RETURN_IF_ERROR(agent->Open());
  TRUEPOSE_RETURN_IF_ERROR(agent->Listen());
  agent->StartThreads(std::move(sources));
  return agent;
}

absl::Status Agent::Open() {
  TRUEPOSE_ASSIGN_OR_RETURN(
      spool_,
      Spool::Open({.folder = config_.spool, .largest_bytes = config_.spool_limit_mb << 20}, disk_));
  for (const std::string& note : spool_->notes()) LogWarning(note);
  TRUEPOSE_ASSIGN_OR_RETURN(
      book_, RequestBook::Open(config_.spool + "/requests", disk_, RobotNames(config_)));
  intake_ = std::make_unique<Intake>(IntakeOptionsOf(config_), *spool_, *book_, [this] { Wake(); });
  desk_ = std::make_unique<Desk>(
      Desk{.sink = *intake_,
           .status = [this] { return Status(); },
           .decline =
               [this](const std::string& robot, const std::string& reason) {
                 TRUEPOSE_RETURN_IF_ERROR(intake_->JointsOf(robot).status());
                 const absl::Status status = book_->Decline(robot, reason);
                 Wake();
                 return status;
               },
           .now = UnixTime,
           .largest_clock_difference_s = static_cast<double>(config_.largest_clock_difference_s),
           .on_refused = [this] { ++refused_; },
           .on_taken = [this](int64_t readings) { taken_ += readings; },
           .operations = ReleasedOperations(DeskOfReleasedSets())});
  return absl::OkStatus();
}

// Before anything is started that Wake and Status use: a connection is answered from here on, but
// what it brings is on the disk, and found there.
absl::Status Agent::Listen() {
  KeepReleasedSets();
  delivery_ = std::make_unique<Delivery>(
      *spool_, client_, DeliveryOptions{.keep = std::chrono::hours(24 * config_.keep_days)},
      LogLine);
  keeper_ = std::make_unique<RequestKeeper>(
      RequestKeeperOptions{.robots = RobotNames(config_),
                           .steps = {.acknowledge = config_.acknowledge},
                           .after_pass = [this] { Report(); }},
      *book_, *spool_, client_, LogLine);
  if (config_.listen.empty()) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(lines_,
                            LineServer::Start(
                                {.listen = config_.listen, .allowed_peers = config_.allowed_peers},
                                [this] { return std::make_unique<ConversationHandler>(*desk_); },
                                [this] { return MetricsText(Status()); }));
  return absl::OkStatus();
}

void Agent::StartThreads(std::vector<std::unique_ptr<Source>> sources) {
  for (const RobotSettings& robot : config_.robots) watches_.push_back(Watch(robot.name));
  sources_ = std::move(sources);
  for (const auto& source : sources_) {
    source_threads_.emplace_back([this, &source = *source] {
      const absl::Status status = source.Run(*intake_, stop_sources_);
      if (status.ok()) return LogInfo(source.name() + " has ended");
      LogError(absl::StrCat(source.name(), ": ", std::string(status.message())));
    });
  }
}

Agent::~Agent() {
  StopTaking();
  for (const auto& watch : watches_) watch->RequestStop();
  for (const auto& keeper : released_) keeper->RequestStop();
  // They notify the keeper.
  watches_.clear();
  keeper_.reset();
  delivery_.reset();
}

void Agent::StopTaking() {
  lines_.reset();
  stop_sources_.Request();
  for (std::thread& thread : source_threads_) thread.join();
  source_threads_.clear();
}

std::string Agent::address() const { return lines_ == nullptr ? "" : lines_->address(); }

void Agent::Wake() {
  delivery_->Notify();
  keeper_->Notify();
}

std::unique_ptr<RobotWatch> Agent::Watch(const std::string& robot) {
  return std::make_unique<RobotWatch>(
      client_, robot,
      RobotWatchHandlers{
          .on_request = [this, robot](const auto& request,
                                      bool is_snapshot) { OnRequest(robot, request, is_snapshot); },
          .on_snapshot = [this, robot](bool has_open) { OnSnapshot(robot, has_open); },
          .on_robot = [this](const v1::Robot& changed) { OnRobot(changed); },
          .on_lost = [this, robot](const absl::Status& why) { OnLost(robot, why); }});
}

void Agent::KeepReleasedSets() {
  for (const std::string& robot : RobotNames(config_))
    released_.push_back(std::make_unique<ReleasedKeeper>(
        client_, disk_,
        ReleasedKeeperOptions{
            .robot = robot,
            .folder = absl::StrCat(config_.spool, "/released/", robot.substr(robot.find('/') + 1))},
        LogLine, WarnLine));
}

ReleasedKeeper* Agent::KeeperOf(const std::string& robot) const {
  for (const auto& keeper : released_)
    if (keeper->robot() == robot) return keeper.get();
  return nullptr;
}

ReleasedDesk Agent::DeskOfReleasedSets() const {
  return {.state = [this](const std::string& robot) -> std::shared_ptr<const ReleasedState> {
            const ReleasedKeeper* const keeper = KeeperOf(robot);
            return keeper == nullptr ? nullptr : keeper->state();
          },
          .on_read_back =
              [this](const std::string& robot, const std::string& controller_state) {
                KeeperOf(robot)->SetControllerState(controller_state);
              }};
}

void Agent::OnRequest(const std::string& robot, const v1::RecalibrationRequest& request,
                      bool is_snapshot) {
  const absl::Status status = book_->Take(robot, request, is_snapshot);
  if (!status.ok()) LogError(std::string(status.message()));
  keeper_->Notify();
}

void Agent::OnSnapshot(const std::string& robot, bool has_open_request) {
  if (!has_open_request) book_->Clear(robot).IgnoreError();
  {
    std::lock_guard lock(mutex_);
    robots_[robot].problem.clear();
    robots_[robot].answered = true;
  }
  Wake();
}

// Readings with another number of joints would be refused by the server for ever.
void Agent::OnRobot(const v1::Robot& robot) {
  const int joints = robot.nominal_revision().nominal().joints_size();
  std::lock_guard lock(mutex_);
  const auto found = robots_.find(robot.name());
  if (found == robots_.end()) return;
  RobotStatus& status = found->second;
  status.active_calibration = robot.active_calibration();
  status.fault =
      joints == status.joints
          ? ""
          : absl::StrCat(robot.name(), " has ", joints,
                         " joints on the server; the configuration says ", status.joints);
  if (!status.fault.empty()) LogError(status.fault);
}

void Agent::OnLost(const std::string& robot, const absl::Status& why) {
  {
    std::lock_guard lock(mutex_);
    robots_[robot].problem = std::string(why.message());
    // What it refuses it has heard.
    robots_[robot].answered = !absl::IsUnavailable(why) && !absl::IsCancelled(why);
  }
  delivery_->DistrustServer();
}

AgentStatus Agent::Status() const {
  const DeliveryState delivery = delivery_->state();
  AgentStatus status;
  status.agent = config_.agent;
  status.version = TRUEPOSE_VERSION;
  status.server = config_.server;
  status.problem = delivery.problem;
  status.delivered_readings = delivery.delivered;
  status.reopened_sessions = delivery.reopened_sessions;
  status.taken_readings = taken_;
  status.refused_messages = refused_;
  status.spool_bytes = spool_->used_bytes();
  status.spool_limit_bytes = spool_->largest_bytes();
  status.done_sessions = static_cast<int64_t>(spool_->Done().size());
  for (const Spool::Session& session : spool_->Sessions()) {
    const auto progress = intake_->Progress(session->content().name());
    if (!progress.ok()) continue;
    status.waiting_readings += progress->readings - progress->delivered;
    status.sessions.push_back(*progress);
  }
  std::lock_guard lock(mutex_);
  for (const auto& [name, robot] : robots_) {
    RobotStatus& added = status.robots.emplace_back(robot);
    if (const auto open = book_->Find(name)) added.request = open->request.name();
    AddReleased(*KeeperOf(name)->state(), &added);
    if (robot.answered) status.connected = true;
  }
  return status;
}

v1::AgentReport Agent::ReportOf(const RobotStatus& robot, const AgentStatus& status) const {
  v1::AgentReport report;
  const std::string id = robot.robot.substr(robot.robot.find('/') + 1);
  report.set_name(absl::StrCat("agentReports/", config_.agent,
                               config_.robots.size() > 1 ? "-" + id : std::string()));
  report.set_robot(robot.robot);
  report.set_version(status.version);
  report.set_spooled_readings(status.waiting_readings);
  report.set_calibration(robot.released);
  report.set_digest(robot.released_digest);
  report.set_controller_state(robot.controller_state);
  if (!robot.released_problem.empty())
    report.set_message(absl::StrCat("released set: ", robot.released_problem));
  if (!robot.fault.empty()) report.set_message(robot.fault);
  for (const SessionProgress& session : status.sessions)
    if (!session.refusal.empty() && session.robot == robot.robot)
      report.set_message(absl::StrCat(session.session, ": ", session.refusal));
  return report;
}

void Agent::Report() {
  const auto now = std::chrono::steady_clock::now();
  const AgentStatus status = Status();
  if (!status.connected) return;
  std::string content;
  for (const RobotStatus& robot : status.robots) {
    v1::AgentReport report = ReportOf(robot, status);
    // How many wait changes all the time; whether any do is news.
    report.set_spooled_readings(std::min<int64_t>(1, report.spooled_readings()));
    content += report.SerializeAsString();
  }
  if (content == last_report_ && now < next_report_) return;
  for (const RobotStatus& robot : status.robots) {
    v1::ReportAgentRequest request;
    *request.mutable_agent_report() = ReportOf(robot, status);
    if (!robot.problem.empty() || !client_.ReportAgent(request).ok()) return;
  }
  last_report_ = content;
  next_report_ = now + kReportInterval;
}

}  // namespace truepose::agent
