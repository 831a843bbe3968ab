// truepose-simulated-agent: a whole agent in front of a robot and an instrument that are made up.
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <numbers>

#include "client/agent/agent.h"
#include "client/agent/config/config_file.h"
#include "client/agent/log.h"
#include "client/agent/simulated/commanded_source.h"
#include "convert/robot.h"
#include "core/base/status_macros.h"
#include "formats/robot_file.h"

namespace truepose::agent {
namespace {

struct Arguments {
  std::string config, robot_file, control;
  uint64_t seed = 1;
  double bump_base_mm = 0.5, bump_deg = 0.02;
  int bump_joint = 3;
};

constexpr double kRad = std::numbers::pi / 180.0;
// So that noise of requests is no other session's.
constexpr uint64_t kNoiseOfRequests = 50'000'000;

CellEvent BumpOf(const Arguments& arguments) {
  CellEvent bump;
  bump.at_s = kBumpAt;
  bump.base_shift_m.x() = 1e-3 * arguments.bump_base_mm;
  bump.joint = arguments.bump_joint - 1;
  bump.joint_shift = arguments.bump_deg * kRad;
  return bump;
}

absl::StatusOr<std::shared_ptr<const Cell>> MakeCell(const Arguments& arguments) {
  TRUEPOSE_ASSIGN_OR_RETURN(const formats::RobotFile file,
                            formats::ReadRobotFile(arguments.robot_file));
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, convert::RobotFrom(file.nominal));
  if (arguments.bump_joint < 1 || arguments.bump_joint > robot.joint_count())
    return absl::InvalidArgumentError("--bump-joint: found none of the robot's joints");
  SimulateOptions options;
  options.seed = arguments.seed;
  options.position_noise_sd_m = 3e-5;
  Pose X_FT;
  X_FT.p.z() = 0.15;
  return std::make_shared<Cell>(robot, ModifiedIncremental(robot, ModelExtent::kInternal), X_FT,
                                options, std::vector<CellEvent>{BumpOf(arguments)});
}

SimulatedOptions OptionsFor(const std::string& robot) {
  SimulatedOptions options;
  options.robot = robot;
  options.content.set_source("simulated");
  options.content.set_placement(robot + "/placements/floor");
  options.content.set_instrument("instruments/tracker");
  return options;
}

std::vector<std::unique_ptr<Source>> SourcesOf(const Arguments& arguments, const std::string& robot,
                                               const std::shared_ptr<const Cell>& cell) {
  const auto clock = std::make_shared<BumpClock>();
  SimulatedOptions answers = OptionsFor(robot);
  answers.for_requests = true;
  answers.noise_from = kNoiseOfRequests;
  std::vector<std::unique_ptr<Source>> sources;
  sources.push_back(
      std::make_unique<CommandedSource>(cell, OptionsFor(robot), arguments.control, clock));
  sources.push_back(
      std::make_unique<SimulatedSource>(cell, answers, [clock] { return clock->Now(); }));
  return sources;
}

absl::Status Serve(const Arguments& arguments) {
  TRUEPOSE_ASSIGN_OR_RETURN(const AgentConfig config, ReadConfigFile(arguments.config));
  if (config.robots.size() != 1)
    return absl::InvalidArgumentError(arguments.config + ": found not one robot, expected one");
  TRUEPOSE_ASSIGN_OR_RETURN(const auto cell, MakeCell(arguments));
  SetLogLevel(config.log_level);
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);
  TRUEPOSE_ASSIGN_OR_RETURN(
      const auto agent, Agent::Start(config, SourcesOf(arguments, config.robots[0].name, cell)));
  int number = 0;
  sigwait(&signals, &number);
  agent->StopTaking();
  std::cerr.flush();
  _exit(0);
}

int Start(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("An agent with a simulated robot, for demonstrations", "truepose-simulated-agent");
  app.add_option("--config", arguments.config, "As of truepose-agent, of one robot")->required();
  app.add_option("--robot-file", arguments.robot_file, "Its nominal geometry")->required();
  app.add_option("--control", arguments.control,
                 "Named pipe for lines: calibrate [POSES], check [POSES], bump")
      ->required();
  app.add_option("--seed", arguments.seed, "Of the robot's errors and of the noise");
  app.add_option("--bump-base-mm", arguments.bump_base_mm, "How far a bump moves the base in x");
  app.add_option("--bump-joint", arguments.bump_joint, "Which joint a bump turns, from 1");
  app.add_option("--bump-deg", arguments.bump_deg, "How far, as read against as it stands");
  CLI11_PARSE(app, argc, argv);
  const absl::Status status = Serve(arguments);
  std::cerr << "truepose-simulated-agent: " << std::string(status.message()) << "\n";
  return 1;
}

}  // namespace
}  // namespace truepose::agent

int main(int argc, char** argv) { return truepose::agent::Start(argc, argv); }
