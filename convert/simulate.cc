#include "core/simulation/simulate.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "convert/frames.h"
#include "convert/robot.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::convert {
namespace {

absl::Status CheckOptions(const SimulationOptions& options) {
  FaultList faults;
  const auto check = [&](const char* field, double value) {
    if (!(value >= 0) || !std::isfinite(value)) faults.Add(field, absl::StrCat(value), "0 or more");
  };
  if (options.poses < 1 || options.poses > 1000000)
    faults.Add("poses", absl::StrCat(options.poses), "1 to 1000000");
  check("length_error_sd_m", options.length_error_sd_m);
  check("angle_error_sd_rad", options.angle_error_sd_rad);
  check("position_noise_sd_m", options.position_noise_sd_m);
  check("rotation_noise_sd_rad", options.rotation_noise_sd_rad);
  check("joint_noise_sd", options.joint_noise_sd);
  check("encoder_resolution", options.encoder_resolution);
  check("joint_range_rad", options.joint_range_rad);
  check("prismatic_range_m", options.prismatic_range_m);
  return faults.ToStatus();
}

SimulateOptions CoreOptions(const SimulationOptions& options) {
  return {options.poses,
          options.seed,
          options.length_error_sd_m,
          options.angle_error_sd_rad,
          options.position_noise_sd_m,
          options.rotation_noise_sd_rad,
          options.joint_noise_sd,
          options.encoder_resolution,
          options.joint_range_rad,
          options.prismatic_range_m};
}

v1::Reading ReadingOf(const SimulatedReading& simulated, int row,
                      const SimulationOptions& options) {
  v1::Reading reading;
  reading.set_row(row);
  for (double value : simulated.q_controller) reading.add_joints_measured(value);
  *reading.mutable_position_m() = ToProto(simulated.X_MT.p);
  *reading.mutable_orientation() = QuaternionToProto(simulated.X_MT.R);
  *reading.mutable_position_sd_m() =
      ToProto(Eigen::Vector3d::Constant(options.position_noise_sd_m).eval());
  return reading;
}

}  // namespace

absl::StatusOr<Simulation> RunSimulation(const v1::Nominal& nominal,
                                         const SimulationOptions& options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckOptions(options));
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(nominal));
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  const Pose X_FT = nominal.tools_size() > 0 ? PoseFrom(nominal.tools(0).pose()) : Pose{};
  const SimulatedSession session = Simulate(robot, model, X_FT, CoreOptions(options));
  Simulation simulation;
  v1::Session* header = simulation.session.mutable_session();
  header->set_source(absl::StrCat("simulated, seed ", options.seed));
  header->set_reading_count(static_cast<int>(session.readings.size()));
  for (size_t i = 0; i < session.readings.size(); ++i) {
    *simulation.session.add_readings() =
        ReadingOf(session.readings[i], static_cast<int>(i), options);
  }
  simulation.convention = model.convention;
  for (int i = 0; i < model.parameters.size(); ++i) {
    simulation.truth.emplace_back();
    simulation.truth.back().set_name(model.parameters[i].name);
    simulation.truth.back().set_value(session.lambda(i));
  }
  simulation.X_MB = ToProto(session.X_MB);
  simulation.X_FT = ToProto(session.X_FT);
  return simulation;
}

}  // namespace truepose::convert
